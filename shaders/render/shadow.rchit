#version 460
#extension GL_EXT_ray_tracing : require

layout(location = 1) rayPayloadInEXT vec3 transmittance;

void main() { transmittance = vec3(0.0); }
