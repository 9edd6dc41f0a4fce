#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/shared/surface.h"

layout(location = 0) rayPayloadInEXT Surface surface;

void main() {
    surface.kind = SURFACE_NONE;
    surface.flags = 0;
    surface.distance = -1.0;
    surface.alpha = 0.0;
}
