#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/render/shapes/surface.glsl"

layout(shaderRecordEXT, scalar) buffer RecordBlock { CsgRecord record; };

void main() {
    fill_surface(record.shape, hit.normal, CsgLeafArray(record.leaves).at[hit.detail].material, vec4(1.0), hit.error);
}
