// Push constants of the resolve stage: one view.
#ifndef FOVERAY_SHARED_RESOLVE_H
#define FOVERAY_SHARED_RESOLVE_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint RESOLVE_BILINEAR = 0u;
FOVERAY_CONST uint RESOLVE_BICUBIC = 1u;

FOVERAY_CONST uint RESOLVE_DEBUG_NONE = 0u;
FOVERAY_CONST uint RESOLVE_DEBUG_TILES = 1u;    // HERR figure 6: 15 degrees of eccentricity and of angle
FOVERAY_CONST uint RESOLVE_DEBUG_SAMPLES = 2u;  // each sample's cell, every other one darkened

struct ResolvePush {
    uint64_t grid;      // SampleGrid
    uint64_t samples;   // LightSample[], of pixel grids
    uint64_t packed;    // light of polar grids: history.h
    uint64_t guides;    // SampleGuide[], of polar grids
    // Written: as in ViewImage.
    uint64_t resolved;
    uint64_t real;
    uint64_t depth;
    uint view;
    uint filter_kind;
    uint debug_view;
    uint layers;  // of `packed`
    float white;  // radiance that is shown as white
};

FOVERAY_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(foveray::shared::ResolvePush) == 80);
#endif

#endif
