#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/tests/gpu/probe_hit.glsl"

layout(shaderRecordEXT, scalar) buffer Record { NarrowRecord record; };

void main() {
    write_hit(PROBE_NARROW);
    hit.record[0] = record.id;
}
