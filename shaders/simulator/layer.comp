#version 450
#extension GL_GOOGLE_include_directive : require

// One layer as one eye sees it, blended over what is behind. OpenXR 1.0, sections 10.6.2 and 12.12 to 12.14.
#include "shaders/simulator/source.glsl"

layout(set = 0, binding = COMPOSITION_FOCUS) uniform sampler2D focus_picture;

const float soft_border = 0.1;  // part of the focus's width or height

// Where a ray from the eye meets the source: (0, 0) is the top left corner, (1, 1) the bottom right one. z: 0 when it
// does not.
vec3 place_in(CompositionSource source, uint kind, vec4 origin, vec3 eye_ray) {
    vec3 d = rotate(source.source_from_eye, eye_ray);
    if (kind <= COMPOSITION_FOCUSED_PROJECTION) {
        if (d.z >= 0.0) return vec3(0.0);
        return vec3((d.xy / -d.z - source.shape.xz) / (source.shape.yw - source.shape.xz), 1.0);
    }
    if (kind == COMPOSITION_QUAD) {  // seen from the front only
        if (origin.z <= 0.0 || d.z >= 0.0) return vec3(0.0);
        vec2 hit = origin.xy - d.xy * (origin.z / d.z);
        return vec3(vec2(0.5, 0.5) + vec2(1.0, -1.0) * hit / source.shape.xy, 1.0);
    }
    // Seen from inside only: the ray meets the wall where it leaves a cylinder or sphere of radius 1.
    vec3 o = origin.w > 0.0 ? origin.xyz / origin.w : vec3(0.0);
    vec3 across = kind == COMPOSITION_CYLINDER ? vec3(1.0, 0.0, 1.0) : vec3(1.0);
    float a = dot(d * across, d), b = dot(o * across, d), c = dot(o * across, o) - 1.0;
    float root = b * b - a * c;
    float t = (-b + sqrt(max(root, 0.0))) / a;
    if (root < 0.0 || !(t > 0.0)) return vec3(0.0);
    vec3 hit = o + t * d;
    float horizontal = 0.5 + atan(hit.x, -hit.z) / source.shape.x;
    if (kind == COMPOSITION_CYLINDER) return vec3(horizontal, 0.5 - hit.y / source.shape.y, 1.0);
    float elevation = asin(clamp(hit.y, -1.0, 1.0));
    return vec3(horizontal, (source.shape.y - elevation) / (source.shape.y - source.shape.z), 1.0);
}

bool is_inside(vec3 place) {
    return place.z > 0.0 && all(greaterThanEqual(place.xy, vec2(0.0))) && all(lessThanEqual(place.xy, vec2(1.0)));
}

// Premultiplied colour of the layer from its texel. XR_KHR_composition_layer_color_scale_bias.
vec4 layer_color(CompositionDraw draw, vec4 texel) {
    uint flags = draw.what.y;
    if ((flags & COMPOSITION_SOURCE_ALPHA) == 0u) texel.a = 1.0;
    if ((flags & COMPOSITION_UNPREMULTIPLIED) != 0u) texel.rgb *= texel.a;
    if ((flags & COMPOSITION_SCALE_BIAS) != 0u) {
        texel.rgb = texel.a > 0.0 ? texel.rgb / texel.a : vec3(0.0);
        texel = clamp(texel * max(draw.scale, vec4(0.0)) + draw.bias, vec4(0.0), vec4(vec3(65504.0), 1.0));
        texel.rgb *= texel.a;
    }
    return texel;
}

// The average over the pixel; nothing where its middle is outside, unless surfaces' edges touch it.
vec4 color_of(CompositionDraw draw, CompositionSource source, sampler2D image, vec2 middle, vec3 place) {
    uint kind = draw.what.x;
    vec2 dx = place_in(source, kind, draw.origin, eye_direction(draw, middle + vec2(1.0, 0.0))).xy - place.xy;
    vec2 dy = place_in(source, kind, draw.origin, eye_direction(draw, middle + vec2(0.0, 1.0))).xy - place.xy;
    int n = samples_for(vec2(length(dx * source.rect.zw), length(dy * source.rect.zw)));
    bool is_surface = kind > COMPOSITION_FOCUSED_PROJECTION;
    vec2 margin = 0.5 * (abs(dx) + abs(dy));
    if (any(lessThan(place.xy, -margin)) || any(greaterThan(place.xy, 1.0 + margin))) return vec4(0.0);
    if (is_surface && (any(lessThan(place.xy, margin)) || any(greaterThan(place.xy, 1.0 - margin)))) n = max(n, 4);

    vec4 sum = vec4(0.0);
    for (int i = 0; i < n * n; ++i) {
        vec3 sampled = place_in(source, kind, draw.origin, eye_direction(draw, middle + sample_offset(i, n)));
        if (is_surface && !is_inside(sampled)) continue;
        sum += layer_color(draw, texel_at(image, source.rect, sampled.xy));
    }
    return sum / float(n * n);
}

// 0 at the edges of the focus, 1 inside its border.
float focus_weight(vec2 place) {
    vec2 t = clamp(min(place, 1.0 - place) / soft_border, 0.0, 1.0);
    t *= t * (3.0 - 2.0 * t);
    return t.x * t.y;
}

void main() {
    CompositionDraw draw = draws[index];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, draw.picture.xy))) return;
    vec2 middle = vec2(pixel) + 0.5;
    vec3 ray = eye_direction(draw, middle);
    uint kind = draw.what.x;

    vec3 place = place_in(draw.source, kind, draw.origin, ray);
    vec4 color = vec4(0.0);
    if (kind <= COMPOSITION_FOCUSED_PROJECTION ? is_inside(place) : place.z > 0.0) {
        color = color_of(draw, draw.source, source_picture, middle, place);
    }
    if (kind == COMPOSITION_FOCUSED_PROJECTION) {
        vec3 in_focus = place_in(draw.focus, kind, draw.origin, ray);
        if (is_inside(in_focus)) {
            color = mix(color, color_of(draw, draw.focus, focus_picture, middle, in_focus), focus_weight(in_focus.xy));
        }
    }
    if (color == vec4(0.0)) return;
    uint at = pixel.y * draw.picture.x + pixel.x;
    vec4 behind = vec4(unpackHalf2x16(light[at].x), unpackHalf2x16(light[at].y));
    vec4 result = color + (1.0 - color.a) * behind;
    light[at] = uvec2(packHalf2x16(result.rg), packHalf2x16(result.ba));
}
