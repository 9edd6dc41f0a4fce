// Where directions fall in a view, and what of it the wearer sees.
#ifndef FOVERAY_RENDER_VIEW_SPACE_GLSL
#define FOVERAY_RENDER_VIEW_SPACE_GLSL

#include "shaders/shared/sample_grid.h"

// Unit direction through an image position; (0, 0) is the top left corner.
vec3 view_direction(ViewParams view, vec2 uv) {
    vec2 tangent = vec2(mix(view.tangents.x, view.tangents.y, uv.x), mix(view.tangents.z, view.tangents.w, uv.y));
    return normalize(view.forward + tangent.x * view.right + tangent.y * view.up);
}

// Angle that a pixel spans there, radians: root of its solid angle.
float pixel_angle(ViewParams view, vec2 uv) {
    vec2 tangent = vec2(mix(view.tangents.x, view.tangents.y, uv.x), mix(view.tangents.z, view.tangents.w, uv.y));
    vec2 pixel = abs(view.tangents.yw - view.tangents.xz) / vec2(view.size);
    return sqrt(pixel.x * pixel.y) * pow(1.0 + dot(tangent, tangent), -0.75);
}

bool hidden_cell(ViewParams view, ivec2 cell) {
    uint index = uint(cell.y) * HIDDEN_MASK_SIZE + uint(cell.x);
    return (UintArray(view.hidden_mask).at[index / 32] >> (index % 32) & 1u) != 0;
}

bool hidden_at(ViewParams view, vec2 uv) {
    if (view.hidden_mask == 0) return false;
    return hidden_cell(view, clamp(ivec2(uv * float(HIDDEN_MASK_SIZE)), ivec2(0), ivec2(HIDDEN_MASK_SIZE - 1)));
}

// Does the wearer see anything of the view within `margin` radians of a unit direction?
bool view_shows(ViewParams view, vec3 direction, float margin) {
    vec3 p = vec3(dot(direction, view.right), dot(direction, view.up), dot(direction, view.forward));
    // Signed sines of the angles to the planes through the eye and the image's edges: inside is positive.
    vec4 t = view.tangents;
    vec4 side = vec4(p.x - t.x * p.z, t.y * p.z - p.x, t.z * p.z - p.y, p.y - t.w * p.z) * inversesqrt(1.0 + t * t);
    if (any(lessThan(side, vec4(-sin(margin))))) return false;
    if (view.hidden_mask == 0) return true;
    if (p.z <= 0.0) return false;
    vec2 tangent = p.xy / p.z;
    vec2 size = vec2(t.y - t.x, t.w - t.z);
    vec2 uv = (tangent - t.xz) / size;
    vec2 reach = abs(margin * (1.0 + dot(tangent, tangent)) / size);
    ivec2 last = ivec2(HIDDEN_MASK_SIZE - 1);
    ivec2 from = clamp(ivec2(floor((uv - reach) * float(HIDDEN_MASK_SIZE))), ivec2(0), last);
    ivec2 to = clamp(ivec2(floor((uv + reach) * float(HIDDEN_MASK_SIZE))), ivec2(0), last);
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x)
            if (!hidden_cell(view, ivec2(x, y))) return true;
    return false;
}

#endif
