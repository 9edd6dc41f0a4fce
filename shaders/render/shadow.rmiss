#version 460
#extension GL_EXT_ray_tracing : require

layout(location = 1) rayPayloadInEXT vec4 shadow;  // trace_shadow.glsl

void main() { shadow.w = 1.0; }
