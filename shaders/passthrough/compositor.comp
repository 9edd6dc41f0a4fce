#version 460
#extension GL_GOOGLE_include_directive : require

// One view: virtual part over the room, or over nothing where the headset shows the room itself. docs/architecture.md,
// "Mixed reality" and "Conventions".
#include "shaders/passthrough/room.glsl"
#include "shaders/passthrough/tone_mapping.glsl"
#include "shaders/shared/compositor.h"
#include "shaders/shared/halves.h"
#include "shaders/render/environment.glsl"
#include "shaders/render/vectors.glsl"
#include "shaders/shared/view_image.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { CompositorPush push; };

vec3 view_direction(uvec2 pixel) {
    vec2 uv = (vec2(pixel) + 0.5) / vec2(push.size);
    vec3 direction = vec3(mix(push.tangents.x, push.tangents.y, uv.x), mix(push.tangents.z, push.tangents.w, uv.y), -1);
    return normalize(rotate(push.stage_from_eye, direction));
}

// Light of the world behind the virtual part, times `transmittance`, plus `added`, as it goes to the display.
vec3 background(RoomParamsRef room, vec3 direction, vec3 transmittance, vec3 added) {
    vec3 radiance;
    if (push.background == BACKGROUND_CAMERA && room_radiance(room, push.origin, direction, radiance)) {
        return push.exposure * (radiance * transmittance + added);
    }
    radiance = vec3(0.0);
    if (push.scene != 0) {
        vec3 direction_world = transpose(mat3(room.value.stage_from_world)) * direction;
        radiance = push.environment_intensity *
                   environment_radiance(SceneDataArray(push.scene).at[0].environment, direction_world, 0.0);
    }
    return tone_map(push.tone_mapping, push.exposure * (radiance * transmittance + added));
}

// Distance along the view's axis to [0, 1], as base/view.h clip_from_eye does.
float projected_depth(float z) {
    if (isinf(z)) return 1.0;
    return clamp(push.far_m * (z - push.near_m) / (z * (push.far_m - push.near_m)), 0.0, 1.0);
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, push.size))) return;
    uint index = pixel.y * push.size.x + pixel.x;
    ResolvedPixel resolved = ResolvedPixelArray(push.resolved).at[index];
    vec4 radiance = unpack_halves(resolved.radiance);
    float coverage = clamp(radiance.a, 0.0, 1.0);
    bool visible = radiance.a >= 0.0;
    vec3 transmittance = vec3(1.0), added = vec3(0.0);
    if (push.real != 0) {
        ResolvedRealPixel real = ResolvedRealPixelArray(push.real).at[index];
        transmittance = unpack_halves(real.transmittance).rgb;
        added = unpack_halves(real.added).rgb;
    }

    // Tone mapping is not linear: it sees the virtual colour without its coverage.
    vec3 color = vec3(0.0);
    if (coverage > 0.0) color = coverage * tone_map(push.tone_mapping, push.exposure * (radiance.rgb / coverage));
    float alpha = 1.0;
    if (push.background == BACKGROUND_RUNTIME) {
        color += (1.0 - coverage) * push.exposure * added;
        alpha = 1.0 - (1.0 - coverage) * dot(transmittance, vec3(0.2126, 0.7152, 0.0722));
    } else if (visible && coverage < 1.0) {
        color += (1.0 - coverage) * background(RoomParamsRef(push.room), view_direction(pixel), transmittance, added);
    }
    vec4 encoded = visible ? vec4(srgb_from_linear(color), alpha) : vec4(0.0, 0.0, 0.0, 1.0);
    UintArray(push.color).at[index] = packUnorm4x8(encoded);
    FloatArray depth = FloatArray(push.depth);
    depth.at[index] = projected_depth(depth.at[index]);
}
