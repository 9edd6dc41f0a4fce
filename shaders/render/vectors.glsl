#ifndef FOVERAY_RENDER_VECTORS_GLSL
#define FOVERAY_RENDER_VECTORS_GLSL

float greatest(vec3 v) { return max(v.x, max(v.y, v.z)); }

// `quaternion`: x, y, z, w; unit length.
vec3 rotate(vec4 quaternion, vec3 v) {
    return v + 2.0 * cross(quaternion.xyz, cross(quaternion.xyz, v) + quaternion.w * v);
}

#endif
