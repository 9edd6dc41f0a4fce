#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/tests/gpu/probe_hit.glsl"

layout(shaderRecordEXT, scalar) buffer Record { ProbeSphereRecord record; };

void main() {
    write_hit(PROBE_SPHERE);
    hit.record[0] = record.id;
}
