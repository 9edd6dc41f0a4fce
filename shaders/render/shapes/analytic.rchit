#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

// Shapes whose intersection shader found the normal.
#include "shaders/render/shapes/surface.glsl"

layout(shaderRecordEXT, scalar) buffer RecordBlock { ShapeHeader shape; };

void main() { fill_surface(shape, hit.normal, shape.material, vec4(1.0), hit.error); }
