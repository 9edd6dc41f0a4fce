// Blends what a probe's rays found into its maps, and decides where the probe stands and whether it sleeps. A group a
// probe: a thread a ray, then a thread a texel of distance and three a texel of light.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/render/probe_field.glsl"
#include "shaders/render/vectors.glsl"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform PushBlock { ProbePush push; };

const float PI = 3.141592653589793;
const uint THREADS = 256;

shared vec3 ray_direction[THREADS];
shared vec4 ray_seen[THREADS];  // radiance, distance
shared vec4 sums[THREADS];

#include "shaders/render/probe_motion.glsl"

// Sum over the group, in the same order every time.
float group_sum(uint thread, float value) {
    sums[thread].x = value;
    for (uint half_count = THREADS / 2; half_count > 0; half_count /= 2) {
        barrier();
        if (thread < half_count) sums[thread].x += sums[thread + half_count].x;
    }
    barrier();
    float total = sums[0].x;
    barrier();
    return total;
}

vec3 texel_direction(uint texel, uint side) {
    vec2 at = vec2(texel % side, texel / side) / float(side - 1);
    return normalize(octahedral_direction(2.0 * at - 1.0));
}

// What is packed stays as it is until what it stands for is clearly nearer to another value: a still scene's pictures do
// not change.
const float KEEP = 0.75;

uint packed_light(uint before, vec3 light) {
    vec3 off = abs(unpack_rgb9e5(before) - light);
    return max(off.r, max(off.g, off.b)) <= KEEP * rgb9e5_step(before) ? before : pack_rgb9e5(light);
}

uint packed_depth(uint before, vec2 moments) {
    vec2 now = vec2(moments.x, sqrt(max(moments.y - moments.x * moments.x, 0.0)));
    vec2 off = abs(unpackHalf2x16(before) - now);
    return max(off.x, off.y) <= KEEP / 512.0 * moments.x ? before : packHalf2x16(now);
}

void update_light(uint probe, ProbeField field, uint thread, bool started, float blend) {
    uint texel = thread / 3;
    vec3 normal = texel_direction(texel, PROBE_LIGHT_SIDE);
    vec4 sum = vec4(0.0);
    for (uint i = thread % 3; i < push.ray_count; i += 3) {
        float weight = max(dot(normal, ray_direction[i]), 0.0);
        if (ray_seen[i].w > 0.0) sum += weight * vec4(ray_seen[i].rgb, 1.0);
    }
    sums[thread] = sum;
    barrier();
    if (thread >= PROBE_LIGHT_TEXELS) return;
    ProbeLightSums light_sums = ProbeLightSums(field.light_sums);
    ProbeTexelArray packed = ProbeTexelArray(field.light);
    uint at = probe * PROBE_LIGHT_TEXELS + thread;
    vec4 total = sums[3 * thread] + sums[3 * thread + 1] + sums[3 * thread + 2];
    vec3 before = started ? light_sums.at[at] : vec3(0.0);
    // Divided by the weights, not by their expectation, so that even light stays exactly even.
    vec3 now = total.w > 0.0 ? PI * total.rgb / total.w : before;
    now = mix(before, now, blend);
    light_sums.at[at] = now;
    packed.at[at] = started ? packed_light(packed.at[at], now) : pack_rgb9e5(now);
}

void update_depth(uint probe, ProbeField field, uint thread, bool started, float blend) {
    vec3 direction = texel_direction(thread, PROBE_DEPTH_SIDE);
    float farthest = 1.5 * length(field.spacing);
    vec3 sum = vec3(0.0);
    for (uint i = 0; i < push.ray_count; ++i) {
        float cosine = dot(direction, ray_direction[i]);
        if (cosine <= 0.5) continue;  // 0.5^50 is nothing
        float c2 = cosine * cosine, c4 = c2 * c2, c8 = c4 * c4, c16 = c8 * c8;
        float weight = c16 * c16 * c16 * c2;
        // What is seen from within is behind a wall: hardly a way at all.
        float seen = ray_seen[i].w;
        float way = min(seen < 0.0 ? -0.2 * seen : seen, farthest);
        sum += weight * vec3(way, way * way, 1.0);
    }
    ProbeDepthSums depth_sums = ProbeDepthSums(field.depth_sums);
    ProbeTexelArray packed = ProbeTexelArray(field.depth);
    uint at = probe * PROBE_DEPTH_TEXELS + thread;
    vec2 before = started ? depth_sums.at[at] : vec2(farthest, farthest * farthest);
    vec2 now = sum.z > 1e-6 ? mix(before, sum.xy / sum.z, blend) : before;
    depth_sums.at[at] = now;
    packed.at[at] = packed_depth(started ? packed.at[at] : 0, now);
}

// Light that has changed at once shows in the mean over all directions, which has little noise. Haste goes on for a while,
// until little of the old light is left.
float hasty(ProbeState state, float brightness, float frames) {
    if (push.fast_decay == 0.0) return 0.0;
    float change = abs(brightness - state.brightness) / max(max(brightness, state.brightness), 1e-6);
    return max(smoothstep(0.25, 0.5, change), state.haste * exp(-0.3 * push.fast_decay * frames));
}

void main() {
    uint probe = gl_WorkGroupID.x, thread = gl_LocalInvocationID.x;
    ProbeField field = ProbeFieldArray(push.probes).at[0];
    ProbeState state = ProbeStateArray(field.states).at[probe];
    if (!probe_is_due(state, probe, push.frame_index, push.flags)) return;
    start_survey(thread);
    vec4 seen = vec4(0.0);
    if (thread < push.ray_count) {
        uvec2 ray = ProbeRayArray(field.rays).at[probe * push.ray_count + thread];
        seen = vec4(unpack_rgb9e5(ray.x), uintBitsToFloat(ray.y));
        ray_direction[thread] = rotate(push.rotation, ProbeDirectionArray(field.directions).at[thread]);
        ray_seen[thread] = seen;
        survey(field, state, thread, ray_direction[thread], seen.w);
    }
    float brightness = group_sum(thread, dot(seen.rgb, vec3(1.0 / 3.0))) / float(push.ray_count);

    bool started = (state.flags & PROBE_STARTED) != 0;
    bool sleeps = started && (state.flags & (PROBE_ASLEEP | PROBE_INSIDE)) != 0 && (push.flags & PROBES_ALL_DUE) == 0;
    float frames = sleeps ? float(PROBE_SLEEP_PERIOD) : 1.0;
    state.haste = hasty(state, brightness, frames);
    float blend = started ? 1.0 - exp(-mix(push.decay, push.fast_decay, state.haste) * frames) : 1.0;
    bool inside = survey_says_inside();
    if (!inside) {
        update_light(probe, field, thread, started, blend);
        update_depth(probe, field, thread, started, blend);
        state.brightness = mix(state.brightness, brightness, blend);
    }
    if (thread == 0) ProbeStateArray(field.states).at[probe] = next_state(field, state, inside);
}
