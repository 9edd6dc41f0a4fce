// What the hit shaders of triangle geometries share: the triangle's corners, its material's textures and their level
// of detail.
#ifndef FOVERAY_RENDER_TRIANGLE_HIT_GLSL
#define FOVERAY_RENDER_TRIANGLE_HIT_GLSL

#include "shaders/engine/textures.glsl"
#include "shaders/shared/scene.h"

layout(shaderRecordEXT, scalar) buffer RecordBlock { TriangleRecord record; };
hitAttributeEXT vec2 barycentrics;

struct Corners {
    uint index[3];
    vec3 weight;
};

Corners hit_corners() {
    UintArray indices = UintArray(record.indices);
    uint first = 3 * gl_PrimitiveID;
    Corners c;
    for (uint i = 0; i < 3; ++i) c.index[i] = indices.at[first + i];
    c.weight = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    return c;
}

vec3 interpolate(Vec3Array values, Corners c) {
    return values.at[c.index[0]] * c.weight.x + values.at[c.index[1]] * c.weight.y +
           values.at[c.index[2]] * c.weight.z;
}

vec4 corner_color(VertexAttributes v) { return vec4(unpackHalf2x16(v.color.x), unpackHalf2x16(v.color.y)); }

// Where textures are read, and how finely.
struct TexturePoint {
    vec2 uv0, uv1;
    float uv0_area, uv1_area;  // twice the triangle's area in uv space
    float texels_term;         // level of detail but for the texture's own density: log2(cone width / area)
};

// Ray cones: Akenine-Möller et al. 2019, "Texture Level of Detail Strategies for Real-Time Ray Tracing", eq. 2 and
// 34. `cone_width` at the hit in metres; corners in world space.
TexturePoint texture_point(VertexAttributes v[3], vec3 weight, vec3 world_corner[3], vec3 ray_direction,
                           float cone_width) {
    TexturePoint p;
    p.uv0 = v[0].uv0 * weight.x + v[1].uv0 * weight.y + v[2].uv0 * weight.z;
    p.uv1 = v[0].uv1 * weight.x + v[1].uv1 * weight.y + v[2].uv1 * weight.z;
    p.uv0_area = abs(determinant(mat2(v[1].uv0 - v[0].uv0, v[2].uv0 - v[0].uv0)));
    p.uv1_area = abs(determinant(mat2(v[1].uv1 - v[0].uv1, v[2].uv1 - v[0].uv1)));
    vec3 across = cross(world_corner[1] - world_corner[0], world_corner[2] - world_corner[0]);
    float area = length(across);
    float cosine = abs(dot(across, ray_direction)) / max(area, 1e-30);
    p.texels_term = log2(max(cone_width, 1e-12) / max(cosine, 1e-3)) - 0.5 * log2(max(area, 1e-30));
    return p;
}

vec4 sample_texture(TextureUse use, TexturePoint p) {
    bool second = use.uv_set == 1;
    vec2 uv = second ? p.uv1 : p.uv0;
    vec2 placed = use.offset + uv.x * use.u_axis + uv.y * use.v_axis;
    vec2 size = vec2(textureSize(textures[nonuniformEXT(use.texture)], 0));
    float area = (second ? p.uv1_area : p.uv0_area) * abs(determinant(mat2(use.u_axis, use.v_axis)));
    float level = p.texels_term + 0.5 * log2(max(area * size.x * size.y, 1e-30));
    return textureLod(textures[nonuniformEXT(use.texture)], placed, max(level, 0.0));
}

// Base colour and alpha, all factors multiplied.
vec4 base_color_at(Material material, VertexAttributes v[3], vec3 weight, TexturePoint p) {
    vec4 color = material.base_color;
    color *= corner_color(v[0]) * weight.x + corner_color(v[1]) * weight.y + corner_color(v[2]) * weight.z;
    if (material.base_color_texture.texture != NO_TEXTURE) color *= sample_texture(material.base_color_texture, p);
    return color;
}

#endif
