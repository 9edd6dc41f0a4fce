#version 460
#extension GL_EXT_ray_tracing : require

layout(location = 1) rayPayloadInEXT vec3 transmittance;

// Nothing opaque stood in the way: what the any-hit shaders left is the answer.
void main() {}
