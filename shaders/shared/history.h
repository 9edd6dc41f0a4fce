// The history stage: polar samples smoothed in space and time, and packed for resolve.
#ifndef FOVERAY_SHARED_HISTORY_H
#define FOVERAY_SHARED_HISTORY_H

#include "shaders/shared/halves.h"
#include "shaders/shared/portable.h"
#include "shaders/shared/sample_grid.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint HISTORY_SPATIAL = 1u;

// What the samples of a frame saw, as much as tells whether two of them saw the same thing.
struct SampleGuide {
    float inverse_distance;  // 1/m; 0: nothing. Linear in the direction over a plane
    uint normal;             // geometric, pack_normal
    uint id;                 // SURFACE_… kind in the lowest two bits, instance and material hashed above
    uint visibility;         // ShadowedLight::visibility
};

// Where what a sample sees was in the polar image of the frame before.
struct PreviousPlace {
    float radial;   // samples, whole numbers at their centres
    float angular;  // samples from angle 0
    float inverse_distance;
};

// Where a frame's samples were.
struct HistoryFrame {
    GazeFrame gaze[2];
    PolarMap polar;
};

// Light by layer and sample, uvec2 each: four halves. Layer 0: radiance of virtual things, premultiplied, and coverage,
// which is PACKED_CULLED where nothing was traced. With real surfaces layers 1 and 2: transmittance and added light,
// both times the part of the sample that shows the real surface.
FOVERAY_CONST float PACKED_CULLED = -1.0f;

struct HistoryPush {
    uint64_t grid;             // SampleGrid
    uint64_t surfaces;         // StoredSurface[]
    uint64_t samples;          // LightSample[]
    uint64_t shadowed;         // ShadowedLight[], or 0
    uint64_t guides;           // SampleGuide[]
    uint64_t previous_guides;  // of the frame before
    uint64_t places;           // PreviousPlace[]; 0: not wanted
    uint64_t smoothed;         // packed light of this frame alone
    uint64_t result;           // packed light with what earlier frames add to it
    uint64_t previous_result;
    uint64_t frame;           // HistoryFrame
    uint64_t previous_frame;
    uint layers;              // 1 or 3
    uint flags;
    float blend;  // share of this frame's light where the history holds, 0 … 1
    float white;  // radiance that is shown as white
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(SampleGuide) == 16 && sizeof(HistoryFrame) == 140 && sizeof(HistoryPush) == 112);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(HistoryFrameArray, HistoryFrame);
FOVERAY_ARRAY(PreviousPlaceArray, PreviousPlace);
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer SampleGuideArray { SampleGuide at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PackedLightArray { uvec2 at[]; };

uvec2 pack_light(vec4 light) { return pack_halves(vec4(min(light.rgb, LARGEST_HALF), light.a)); }
#endif

#endif
