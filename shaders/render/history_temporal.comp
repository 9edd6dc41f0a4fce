#version 460
#extension GL_GOOGLE_include_directive : require

// Third pass of the history stage: blends a frame with the frames before it, followed to where they saw the same.
// Karis 2014, "High Quality Temporal Supersampling", on the polar image.
#include "shaders/render/history.glsl"

layout(local_size_x = 16, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { HistoryPush push; };

const float SLACK = 0.02;      // of the distance, on a sample's own surface
const float EDGE_SLACK = 0.1;  // on a surface beside it
// Surfaces side by side that moved apart by less draw one edge, else one uncovers the other. Samples.
const float TOGETHER = 0.5;
// History further than this from the mean of the neighbourhood, in standard deviations, no longer holds.
const float CLAMP_SIGMAS = 1.5;
// A sample that moved less is taken not to have: rounding must not creep in a still picture. Samples.
const float STILL = 0.02;
// History that differs from the frame by less, relative, is done: half a step of a display.
const float DONE = 1.0 / 512.0;
const float DARK = 1e-4;           // and what no display shows
const float LEAST_HISTORY = 0.05;  // part of the four samples round the place that must hold

// What is beside a sample at an edge that moves with it: there the samples of one frame fall on either side, and only
// all frames together draw it smoothly.
const uint NOTHING_BESIDE = 0xFFFFFFFFu;  // no sample's id
struct Beside {
    uint id[NEIGHBOURS];
    float inverse_distance[NEIGHBOURS];
    bool any_edge;
};

// Difference of polar places the shorter way round the circle.
vec2 round_difference(vec2 difference, float height) {
    return vec2(difference.x, difference.y - height * round(difference.y / height));
}

Beside beside(PolarMap map, PolarMap map_before, Neighbourhood around, SeenPlane plane, uint id, vec2 was_at) {
    Beside result;
    result.any_edge = false;
    vec2 then_from_now = vec2(map_before.width, map_before.height) / vec2(map.width, map.height);
    [[unroll]] for (int i = 0; i < NEIGHBOURS; ++i) {
        SampleGuide other = SampleGuideArray(push.guides).at[around.index[i]];
        result.id[i] = NOTHING_BESIDE;
        result.inverse_distance[i] = other.inverse_distance;
        if (kind_of(other) == SURFACE_CULLED || same_surface(plane, id, around.steps[i], other, SLACK)) continue;
        result.any_edge = true;
        PreviousPlace was = PreviousPlaceArray(push.places).at[around.index[i]];
        vec2 apart = round_difference(vec2(was.radial, was.angular) - was_at, float(map_before.height));
        if (length(apart - then_from_now * around.steps[i]) < TOGETHER) result.id[i] = other.id;
    }
    return result;
}

bool holds_beside(Beside b, SampleGuide then) {
    bool holds = false;
    [[unroll]] for (int i = 0; i < NEIGHBOURS; ++i) {
        float slack = EDGE_SLACK * b.inverse_distance[i];
        holds = holds || (then.id == b.id[i] && abs(then.inverse_distance - b.inverse_distance[i]) <= slack);
    }
    return holds;
}

// The four samples of the frame before round a place, those that saw the same with their weights.
struct History {
    uint index[4];
    float weight[4];
    float total;
    bool all_hold;
};

History history_at(PolarMap map, uint eye, vec2 place, SeenPlane plane, uint id, Beside beside) {
    History h;
    h.total = 0.0;
    h.all_hold = true;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int ring = min(int(floor(place.x)) + (i >> 1), int(map.width) - 1);
        float center = place.y - polar_ring_start(uint(ring));
        int along = int(floor(center)) + (i & 1);
        vec2 steps = vec2(ring, along) - vec2(place.x, center);
        h.index[i] = sample_at(map, eye, ring, along);
        SampleGuide then = SampleGuideArray(push.previous_guides).at[h.index[i]];
        bool holds = same_surface(plane, id, steps, then, SLACK) || holds_beside(beside, then);
        h.all_hold = h.all_hold && holds;
        h.weight[i] = holds ? max(1.0 - abs(steps.x), 0.0) * max(1.0 - abs(steps.y), 0.0) : 0.0;
        h.total += h.weight[i];
    }
    return h;
}

vec4 linear_light(History h, uint layer_start) {
    vec4 sum = vec4(0.0);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        if (h.weight[i] == 0.0) continue;
        sum += h.weight[i] * unpack_halves(PackedLightArray(push.previous_result).at[layer_start + h.index[i]]);
    }
    return sum / h.total;
}

// Catmull and Rom's spline at the four samples round a place `f` of the way from the second to the third. Repeated
// every frame, anything softer would blur what moves.
vec4 spline_taps(float f) {
    float f2 = f * f, f3 = f2 * f;
    return 0.5 * vec4(2.0 * f2 - f3 - f, 3.0 * f3 - 5.0 * f2 + 2.0, 4.0 * f2 - 3.0 * f3 + f, f3 - f2);
}

vec4 spline_light(PolarMap map, uint eye, vec2 place, uint layer_start) {
    vec4 sum = vec4(0.0);
    vec4 radial = spline_taps(fract(place.x));
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int ring = int(floor(place.x)) - 1 + i;
        float center = place.y - polar_ring_start(uint(ring));
        vec4 angular = spline_taps(fract(center));
        vec4 along = vec4(0.0);
        [[unroll]] for (int j = 0; j < 4; ++j) {
            uint index = sample_at(map, eye, ring, int(floor(center)) - 1 + j);
            along += angular[j] * unpack_halves(PackedLightArray(push.previous_result).at[layer_start + index]);
        }
        sum += radial[i] * along;
    }
    return sum;
}

void main() {
    SampleGridArray grid = SampleGridArray(push.grid);
    PolarMap map = grid.at[0].polar;
    uvec3 at = gl_GlobalInvocationID;
    if (at.x >= map.width || at.y >= map.height) return;
    uint eye = at.z;
    ivec2 place = ivec2(at.xy);
    uint index = sample_at(map, eye, place.x, place.y);
    uint count = grid.at[0].sample_count;
    PackedLightArray smoothed = PackedLightArray(push.smoothed);
    PackedLightArray result = PackedLightArray(push.result);
    for (uint layer = 0; layer < push.layers; ++layer) {
        result.at[layer * count + index] = smoothed.at[layer * count + index];
    }
    SampleGuide own = SampleGuideArray(push.guides).at[index];
    float strength = (1.0 - push.blend) * periphery(map, sample_eccentricity(map, at.x));
    if (strength == 0.0 || kind_of(own) == SURFACE_CULLED) return;

    PolarMap map_before = HistoryFrameArray(push.previous_frame).at[0].polar;
    PreviousPlace was = PreviousPlaceArray(push.places).at[index];
    if (was.radial < 0.0 || was.radial > float(map_before.width) - 1.0) return;
    vec2 was_at = vec2(was.radial, was.angular), is_at = vec2(place) + vec2(0.0, polar_ring_start(at.x));
    if (map == map_before && length(round_difference(was_at - is_at, float(map.height))) < STILL) was_at = is_at;

    GazeFrame gaze = GazeFrameArray(grid.at[0].gaze_frames).at[eye];
    SeenPlane plane = seen_plane(map, gaze, at.x, float(place.y), own);
    Neighbourhood around = neighbourhood(map, eye, place);
    Beside edge = beside(map, map_before, around, plane, own.id, was_at);
    plane.inverse_distance = was.inverse_distance;
    History history = history_at(map_before, eye, was_at, plane, own.id, edge);
    if (history.total < LEAST_HISTORY) return;
    bool smooth_surface = history.all_hold && !edge.any_edge && abs(was_at.x / float(map_before.width) - 0.5) < 0.49;

    uint count_before = 2 * map_before.width * map_before.height;
    for (uint layer = 0; layer < push.layers; ++layer) {
        vec4 now = unpack_halves(smoothed.at[layer * count + index]);
        vec4 mean = now, square = now * now;
        float number = 1.0;
        [[unroll]] for (int i = 0; i < NEIGHBOURS; ++i) {
            if (unpackHalf2x16(smoothed.at[around.index[i]].y).y == PACKED_CULLED) continue;
            vec4 other = unpack_halves(smoothed.at[layer * count + around.index[i]]);
            mean += other;
            square += other * other;
            number += 1.0;
        }
        mean /= number;
        vec4 reach = CLAMP_SIGMAS * sqrt(max(square / number - mean * mean, vec4(0.0)));
        vec4 then = smooth_surface ? spline_light(map_before, eye, was_at, layer * count_before)
                                   : linear_light(history, layer * count_before);
        // What stays as it is must hold, however far it stands out.
        then = clamp(then, min(mean - reach, now), max(mean + reach, now));
        if (all(lessThanEqual(abs(then - now), DONE * abs(now) + DARK))) continue;
        result.at[layer * count + index] = pack_light(mix(now, then, strength));
    }
}
