#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#define GEOMETRY_TYPE 0
#include "shaders/tests/shapes/record.glsl"
