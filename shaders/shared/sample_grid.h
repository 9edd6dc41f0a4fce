// Which directions are sampled. Two kinds: a polar image an eye, or every pixel of every view (--reference).
#ifndef FOVERAY_SHARED_SAMPLE_GRID_H
#define FOVERAY_SHARED_SAMPLE_GRID_H

#include "shaders/shared/polar.h"
#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint MAX_VIEWS = 4u;
FOVERAY_CONST uint HIDDEN_MASK_SIZE = 128u;  // cells a side of a view's visibility mask

FOVERAY_CONST uint GRID_POLAR = 0u;
FOVERAY_CONST uint GRID_PIXELS = 1u;

// A view in world space.
struct ViewParams {
    vec3 origin;
    uint eye;
    vec3 right;
    uint role;
    vec3 up;
    uint first_sample;  // GRID_PIXELS: index of the view's first sample; GRID_POLAR: of its eye's
    vec3 forward;
    uint pad;
    vec4 tangents;  // left, right, up, down: tan of the half-angles, signs as in XrFovf
    uvec2 size;     // pixels
    uint64_t hidden_mask;  // uint[HIDDEN_MASK_SIZE² / 32], a bit a cell, row by row from the top; 0: all is seen
};

// The frame round one eye's gaze: written by the fixation stage, on the GPU.
struct GazeFrame {
    vec3 origin;  // eye, world
    float distance;  // of the fixation point, metres
    vec3 forward;  // unit length, to the fixation point
    vec3 right;    // angle 0 of the polar image: the eye's right vector made orthogonal to forward
    vec3 up;       // angle 90°, counter-clockwise
};

struct SampleGrid {
    uint kind;
    uint view_count;
    uint sample_count;  // all eyes or views
    uint frame_index;
    vec2 jitter;  // GRID_PIXELS: position in the pixel, about 0 … 1
    uint sub_sample;
    uint sub_sample_count;  // samples of a pixel that are averaged; each stands for its share of the pixel
    uint64_t gaze_frames;  // GazeFrame[2]
    PolarMap polar;        // GRID_POLAR: sample = (eye * height + angular) * width + radial, at the angle
                           // 2π (angular + polar_ring_start(radial)) / height
    ViewParams views[4];
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(ViewParams) == 96 && offsetof(ViewParams, hidden_mask) == 88);
static_assert(sizeof(GazeFrame) == 52 && offsetof(GazeFrame, up) == 40);
static_assert(sizeof(SampleGrid) == 464 && offsetof(SampleGrid, views) == 80);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(GazeFrameArray, GazeFrame);
FOVERAY_ARRAY(SampleGridArray, SampleGrid);
#endif

#endif
