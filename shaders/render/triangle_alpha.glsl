// Colour and alpha for any-hit shaders, which need no more of the surface.
#ifndef FOVERAY_RENDER_TRIANGLE_ALPHA_GLSL
#define FOVERAY_RENDER_TRIANGLE_ALPHA_GLSL

#include "shaders/render/triangle_hit.glsl"

vec4 hit_color(Material material, float cone_width) {
    Corners c = hit_corners();
    VertexAttributesArray attributes = VertexAttributesArray(record.attributes);
    VertexAttributes v[3];
    vec3 corner[3];
    Vec3Array positions = Vec3Array(record.positions);
    for (uint i = 0; i < 3; ++i) {
        v[i] = attributes.at[c.index[i]];
        corner[i] = gl_ObjectToWorldEXT * vec4(positions.at[c.index[i]], 1.0);
    }
    TexturePoint p = texture_point(v, c.weight, corner, gl_WorldRayDirectionEXT, cone_width);
    return base_color_at(material, v, c.weight, p);
}

#endif
