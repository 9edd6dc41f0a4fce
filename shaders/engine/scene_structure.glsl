// The acceleration structure that rays are traced into: set 1 of every ray-tracing pipeline.
#ifndef FOVERAY_ENGINE_SCENE_STRUCTURE_GLSL
#define FOVERAY_ENGINE_SCENE_STRUCTURE_GLSL

layout(set = 1, binding = 0) uniform accelerationStructureEXT scene_structure;

#endif
