#version 460
#extension GL_GOOGLE_include_directive : require

// Second pass of the history stage: takes noise out of one frame. Of shadows only how much light arrives is averaged,
// over neighbours that saw the same surface, so that textures and mirror images stay as they are.
#include "shaders/render/history.glsl"
#include "shaders/render/vectors.glsl"

layout(local_size_x = 16, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { HistoryPush push; };

const int REACH = 3;         // rings
const float SIGMA = 1.75;    // samples, in the periphery
const float SLACK = 0.02;
// What samples on other sides of the same thing count: something where a lone one met a detail smaller than a sample.
const float OTHER_SIDE = 0.1;

vec3 smoothed_visibility(PolarMap map, uint eye, ivec2 place, SampleGuide own, float strength) {
    SampleGuideArray guides = SampleGuideArray(push.guides);
    GazeFrame gaze = GazeFrameArray(SampleGridArray(push.grid).at[0].gaze_frames).at[eye];
    SeenPlane plane = seen_plane(map, gaze, uint(place.x), float(place.y), own);
    float falloff = 0.5 / (SIGMA * SIGMA);
    vec3 visibility = unpack_visibility(own.visibility);
    vec3 sum = visibility;
    float weight = 1.0;
    for (int ring = -REACH; ring <= REACH; ++ring) {
        int radial = place.x + ring;
        if (radial < 0 || radial >= int(map.width)) continue;
        float offset = polar_ring_start(uint(place.x)) - polar_ring_start(uint(radial));
        bool odd = (ring & 1) != 0;
        float reach = float(REACH) - (odd ? 0.5 : 0.0);
        for (float along = -reach; along <= reach; along += 1.0) {
            if (ring == 0 && along == 0.0) continue;
            SampleGuide other = guides.at[sample_at(map, eye, radial, place.y + int(round(along + offset)))];
            vec2 steps = vec2(ring, along);
            if (other.id != own.id) continue;
            float w = strength * exp(-falloff * dot(steps, steps));
            if (!same_surface(plane, own.id, steps, other, SLACK)) w *= OTHER_SIDE;
            sum += w * unpack_visibility(other.visibility);
            weight += w;
        }
    }
    return sum / weight;
}

// A highlight smaller than a sample, such as a mirrored lamp's on something round, is met by one now and by none then,
// and would flash as large as a sample. A lone one is as bright as its neighbours, or white.
vec3 without_flash(PolarMap map, uint eye, ivec2 place, vec3 radiance, float strength) {
    float own = greatest(radiance), around = push.white;
    if (own <= around) return radiance;
    Neighbourhood n = neighbourhood(map, eye, place);
    [[unroll]] for (int i = 0; i < NEIGHBOURS; ++i) {
        LightSample other = LightSampleArray(push.samples).at[n.index[i]];
        if (other.valid != 0.0) around = max(around, greatest(other.radiance));
    }
    return mix(radiance, radiance * min(around / own, 1.0), strength);
}

void main() {
    SampleGridArray grid = SampleGridArray(push.grid);
    PolarMap map = grid.at[0].polar;
    uvec3 at = gl_GlobalInvocationID;
    if (at.x >= map.width || at.y >= map.height) return;
    uint index = sample_at(map, at.z, int(at.x), int(at.y));
    uint count = grid.at[0].sample_count;
    PackedLightArray smoothed = PackedLightArray(push.smoothed);
    LightSample light = LightSampleArray(push.samples).at[index];
    if (light.valid == 0.0) {
        smoothed.at[index] = pack_light(vec4(0.0, 0.0, 0.0, PACKED_CULLED));
        return;
    }
    float strength = periphery(map, sample_eccentricity(map, at.x));
    if ((push.flags & HISTORY_SPATIAL) != 0 && push.shadowed != 0 && strength > 0.0) {
        ShadowedLight shadowed = ShadowedLightArray(push.shadowed).at[index];
        SampleGuide own = SampleGuideArray(push.guides).at[index];
        vec3 open = unpack_halves(shadowed.open).rgb;
        if (open != vec3(0.0)) {
            vec3 visibility = smoothed_visibility(map, at.z, ivec2(at.xy), own, strength);
            vec3 change = open * (visibility - unpack_visibility(own.visibility));
            if (kind_of(own) == SURFACE_REAL) {
                light.transmittance = max(light.transmittance + change, vec3(0.0));
            } else {
                light.radiance = max(light.radiance + change, vec3(0.0));
            }
        }
    }
    if (strength > 0.0) light.radiance = without_flash(map, at.z, ivec2(at.xy), light.radiance, strength);
    smoothed.at[index] = pack_light(vec4(light.radiance, light.coverage));
    if (push.layers == 1) return;
    float seen = 1.0 - light.coverage;
    smoothed.at[count + index] = pack_light(vec4(seen * light.transmittance, 0.0));
    smoothed.at[2 * count + index] = pack_light(vec4(seen * light.added, 0.0));
}
