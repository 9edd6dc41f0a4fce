#version 460
#extension GL_GOOGLE_include_directive : require

// Second pass of the history stage: takes the noise of shadows out of one frame. Only how much light arrives is
// averaged, over neighbours that saw the same surface, so that textures and mirror images stay as they are.
#include "shaders/render/history.glsl"

layout(local_size_x = 16, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { HistoryPush push; };

const int REACH = 2;         // rings
const float SIGMA = 1.25;    // samples, in the periphery
const float SLACK = 0.02;

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
            if (!same_surface(plane, own.id, steps, other, SLACK)) continue;
            float w = strength * exp(-falloff * dot(steps, steps));
            sum += w * unpack_visibility(other.visibility);
            weight += w;
        }
    }
    return sum / weight;
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
    smoothed.at[index] = pack_light(vec4(light.radiance, light.coverage));
    if (push.layers == 1) return;
    float seen = 1.0 - light.coverage;
    smoothed.at[count + index] = pack_light(vec4(seen * light.transmittance, 0.0));
    smoothed.at[2 * count + index] = pack_light(vec4(seen * light.added, 0.0));
}
