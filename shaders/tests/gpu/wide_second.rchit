#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/tests/gpu/wide_hit.glsl"

void main() { write_wide_hit(PROBE_WIDE_SECOND); }
