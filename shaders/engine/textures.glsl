// The texture table: gpu::TextureTable, set 0 of every pipeline.
#ifndef FOVERAY_ENGINE_TEXTURES_GLSL
#define FOVERAY_ENGINE_TEXTURES_GLSL

#extension GL_EXT_nonuniform_qualifier : require

layout(set = 0, binding = 0) uniform sampler2D textures[];

#endif
