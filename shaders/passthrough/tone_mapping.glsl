#ifndef FOVERAY_PASSTHROUGH_TONE_MAPPING_GLSL
#define FOVERAY_PASSTHROUGH_TONE_MAPPING_GLSL

#include "shaders/shared/compositor.h"

// Khronos PBR Neutral Tone Mapper, specification 1.0: keeps base colours, compresses highlights above 0.8.
vec3 tone_map_neutral(vec3 color) {
    const float start = 0.8 - 0.04;
    const float desaturation = 0.15;
    float least = min(color.r, min(color.g, color.b));
    color -= least < 0.08 ? least - 6.25 * least * least : 0.04;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < start) return color;
    const float room = 1.0 - start;
    float new_peak = 1.0 - room * room / (peak + room - start);
    color *= new_peak / peak;
    return mix(color, vec3(new_peak), 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0));
}

vec3 tone_map(uint mapping, vec3 color) { return mapping == TONE_MAPPING_NEUTRAL ? tone_map_neutral(color) : color; }

// IEC 61966-2-1
vec3 srgb_from_linear(vec3 color) {
    color = clamp(color, 0.0, 1.0);
    return mix(1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, 12.92 * color, lessThanEqual(color, vec3(0.0031308)));
}

#endif
