// A grid of light probes: dynamic diffuse global illumination (Majercik et al. 2019, "Dynamic Diffuse Global Illumination
// with Ray-Traced Irradiance Fields", JCGT 8(2); Majercik et al. 2021, "Scaling Probe-Based Real-Time Dynamic Global
// Illumination for Production", JCGT 10(2)). World space, metres.
#ifndef FOVERAY_SHARED_PROBES_H
#define FOVERAY_SHARED_PROBES_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint PROBE_MAX_RAYS = 256u;
// Texels a side of a probe's octahedral maps. The outermost ones stand on the map's edges, where they repeat one another,
// so that lookups need neither border nor wrapping; and with an odd number texels stand on the axes, so that walls and
// floors are lit without interpolation, which would take in light from behind them.
FOVERAY_CONST uint PROBE_LIGHT_SIDE = 9u;
FOVERAY_CONST uint PROBE_DEPTH_SIDE = 16u;
FOVERAY_CONST uint PROBE_LIGHT_TEXELS = 81u;
FOVERAY_CONST uint PROBE_DEPTH_TEXELS = 256u;
// Sleeping probes look about in every so manieth frame: a number that shares no factor with the cycle of rotations, so
// that they too see all of them.
FOVERAY_CONST uint PROBE_SLEEP_PERIOD = 7u;
FOVERAY_CONST uint PROBE_ROTATIONS = 64u;

FOVERAY_CONST uint PROBE_STARTED = 1u;  // its maps hold something
FOVERAY_CONST uint PROBE_INSIDE = 2u;   // within geometry: sees nothing that anyone sees, and sleeps
FOVERAY_CONST uint PROBE_ASLEEP = 4u;   // nothing near that it could light
FOVERAY_CONST uint PROBE_QUIET_STEP = 256u;  // bits from here on: updates in a row without anything near, at most 255

struct ProbeState {
    vec3 offset;  // from the probe's place in the grid
    uint flags;
    float brightness;  // mean radiance round it, as its maps have it
    float haste;       // 0 … 1: its light has changed at once, and what it was is forgotten fast
};

struct ProbeField {
    vec3 first;  // where the grid's first probe belongs
    uint count_x;
    vec3 spacing;
    uint count_y;
    uint count_z;
    uint pad;
    uint64_t states;      // ProbeState[probe]; x runs fastest, then y, then z
    uint64_t light;       // uint[probe][PROBE_LIGHT_TEXELS]: irradiance as rgb9e5
    uint64_t depth;       // uint[probe][PROBE_DEPTH_TEXELS]: mean distance and its standard deviation, two halves
    uint64_t light_sums;  // vec3[probe][PROBE_LIGHT_TEXELS]: what `light` is made from, unrounded
    uint64_t depth_sums;  // vec2[probe][PROBE_DEPTH_TEXELS]: means of distance and of its square
    uint64_t rays;        // uvec2[probe][ray]: radiance as rgb9e5, distance (< 0: to the inner side of something)
    uint64_t directions;  // vec3[ray]: evenly over the sphere, neighbours close together
};

FOVERAY_CONST uint PROBES_SHADOWS = 1u;    // the same as LIGHTING_SHADOWS (lighting.h)
FOVERAY_CONST uint PROBES_SLEEP = 2u;      // probes may sleep
FOVERAY_CONST uint PROBES_ALL_DUE = 4u;    // even those that sleep look about in this frame
FOVERAY_CONST uint PROBES_RELOCATE = 8u;   // geometry has changed: probes may move

// Of the tracing and of the update alike.
struct ProbePush {
    uint64_t probes;    // ProbeField
    uint64_t scene;     // SceneData
    uint64_t counters;  // uint[], see light_layers.h
    vec4 rotation;      // of the ray directions: quaternion x, y, z, w
    uint flags;
    uint ray_count;
    uint frame_index;
    float environment_intensity;
    float decay;       // how much of the past a frame forgets: 1 - exp(-decay)
    float fast_decay;  // the same, of probes whose light has changed at once; 0: none has
};

FOVERAY_INLINE float probe_sign(float v) { return v < 0.0f ? -1.0f : 1.0f; }

// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors": a unit vector to [-1, 1]².
FOVERAY_INLINE vec2 octahedral_from_direction(vec3 d) {
    float sum = max(d.x, -d.x) + max(d.y, -d.y) + max(d.z, -d.z);
    vec2 p = vec2(d.x / sum, d.z / sum);
    if (d.y >= 0.0f) return p;
    return vec2((1.0f - max(p.y, -p.y)) * probe_sign(p.x), (1.0f - max(p.x, -p.x)) * probe_sign(p.y));
}

// Of any length.
FOVERAY_INLINE vec3 octahedral_direction(vec2 p) {
    float up = 1.0f - max(p.x, -p.x) - max(p.y, -p.y);
    if (up >= 0.0f) return vec3(p.x, up, p.y);
    return vec3((1.0f - max(p.y, -p.y)) * probe_sign(p.x), up, (1.0f - max(p.x, -p.x)) * probe_sign(p.y));
}

// Shared-exponent colours: 9 bits of mantissa each, 5 of exponent (Vulkan's E5B9G9R9).
FOVERAY_INLINE vec3 unpack_rgb9e5(uint bits) {
    float scale = exp2(float(bits >> 27) - 24.0f);
    return scale * vec3(float(bits & 511u), float(bits >> 9 & 511u), float(bits >> 18 & 511u));
}

// What one step of a packed colour's mantissa is worth.
FOVERAY_INLINE float rgb9e5_step(uint bits) { return exp2(float(bits >> 27) - 24.0f); }

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(ProbeState) == 24 && offsetof(ProbeState, haste) == 20);
static_assert(sizeof(ProbeField) == 96 && offsetof(ProbeField, directions) == 88);
static_assert(sizeof(ProbePush) == 64 && offsetof(ProbePush, fast_decay) == 60);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(ProbeStateArray, ProbeState);
FOVERAY_ARRAY(ProbeFieldArray, ProbeField);
FOVERAY_ARRAY(ProbeTexelArray, uint);
FOVERAY_ARRAY(ProbeLightSums, vec3);
FOVERAY_ARRAY(ProbeDepthSums, vec2);
FOVERAY_ARRAY(ProbeRayArray, uvec2);
FOVERAY_ARRAY(ProbeDirectionArray, vec3);

// The largest component decides the exponent.
uint pack_rgb9e5(vec3 color) {
    const float largest_value = 65408.0;
    vec3 c = clamp(color, vec3(0.0), vec3(largest_value));
    float largest = max(max(c.r, c.g), max(c.b, 1e-7));
    int exponent = max(-16, int(floor(log2(largest)))) + 1;
    if (floor(largest * exp2(9.0 - float(exponent)) + 0.5) >= 512.0) ++exponent;
    uvec3 m = uvec3(c * exp2(9.0 - float(exponent)) + 0.5);
    return m.r | m.g << 9 | m.b << 18 | uint(exponent + 15) << 27;
}
#endif

#endif
