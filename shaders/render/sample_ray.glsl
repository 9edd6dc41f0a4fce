// The ray of a sample.
#ifndef FOVERAY_RENDER_SAMPLE_RAY_GLSL
#define FOVERAY_RENDER_SAMPLE_RAY_GLSL

#include "shaders/shared/ray_cone.h"
#include "shaders/shared/scene.h"
#include "shaders/render/gaze_frame.glsl"
#include "shaders/render/view_space.glsl"

// Samples or pixels, whichever are larger, that resolve's filter reaches to, with one to spare.
const float FILTER_REACH = 3.0;

// Width of a polar sample's cone in samples, and the least ratio of angular to radial spacing that it follows.
const float CONE_SPACINGS = 1.3;
const float LEAST_CONE_RATIO = 0.6;

bool polar_sample_ray(SampleGridArray grid, uint index, out vec3 origin, out vec3 direction, out float cone_spread) {
    PolarMap map = grid.at[0].polar;
    uint eye = index / (map.width * map.height);
    uint angular = index / map.width % map.height;
    uint radial = index % map.width;
    GazeFrame gaze = GazeFrameArray(grid.at[0].gaze_frames).at[eye];
    float e = polar_eccentricity(map, (float(radial) + 0.5) * map.radius_outer / float(map.width));
    origin = gaze.origin;
    direction = polar_direction(gaze, e, TWO_PI * (float(angular) + polar_ring_start(radial)) / float(map.height));
    float radial_spacing = radians(polar_radial_spacing(map, e));
    float angular_spacing = radians(polar_angular_spacing(map, e));
    // As wide as lets no grating above half the density come back as a coarser one, and keeps those of a quarter of it
    // (tests/render/light/acuity_chart_test.cpp). Rings in quincunx show along the circle what they show along the
    // radius, though angular samples are up to half as far apart again. Where they crowd, near the gaze, the cone shrinks
    // to a pixel's of the full resolution.
    float across = clamp(angular_spacing, LEAST_CONE_RATIO * radial_spacing, radial_spacing);
    cone_spread = CONE_SPACINGS * sqrt(radial_spacing * across);
    float spacing = max(radial_spacing, angular_spacing);
    for (uint i = 0; i < grid.at[0].view_count; ++i) {
        ViewParams view = grid.at[0].views[i];
        float margin = FILTER_REACH * max(spacing, pixel_angle(view, vec2(0.5)));
        if (view.eye == eye && view_shows(view, direction, margin)) return true;
    }
    return false;
}

bool pixel_sample_ray(SampleGridArray grid, uint index, out vec3 origin, out vec3 direction, out float cone_spread) {
    uint i = grid.at[0].view_count - 1;
    while (index < grid.at[0].views[i].first_sample) --i;
    ViewParams view = grid.at[0].views[i];
    uint pixel = index - view.first_sample;
    vec2 uv = (vec2(pixel % view.size.x, pixel / view.size.x) + grid.at[0].jitter) / vec2(view.size);
    origin = view.origin;
    direction = view_direction(view, uv);
    cone_spread = pixel_angle(view, uv) * inversesqrt(float(grid.at[0].sub_sample_count));
    return !hidden_at(view, uv);
}

// Origin in world space, unit direction. False: no view shows the sample, and nothing should be traced.
bool sample_ray(SampleGridArray grid, uint index, out vec3 origin, out vec3 direction, out RayCone cone) {
    cone.width = 0.0;
    if (grid.at[0].kind == GRID_POLAR) return polar_sample_ray(grid, index, origin, direction, cone.spread);
    return pixel_sample_ray(grid, index, origin, direction, cone.spread);
}

#endif
