#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/shared/ray_types.h"
#include "shaders/tests/shapes/rays.h"

layout(location = 0) rayPayloadInEXT RecordSeen seen;

void main() {
    seen.geometry_type = NO_TYPE;
    seen.instance = RAY_SHADOW;
}
