#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/tests/gpu/probe.h"

layout(location = 0) rayPayloadInEXT ProbeHit hit;

void main() { hit.shader = PROBE_MISS + 1u; }
