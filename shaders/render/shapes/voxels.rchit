#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

// The length of the hit's normal is the width of the voxel or node, its error the length of a partly covering hit.
#include "shaders/render/shapes/surface.glsl"
#include "shaders/shared/voxels.h"

layout(shaderRecordEXT, scalar) buffer RecordBlock { VoxelRecord record; };

// Secondary rays start so many voxels off the surface: cubes stand out of the smooth surface that they stand for.
const float STEPS_OFF = 1.5;

void main() {
    vec4 seen = unpackUnorm4x8(hit.detail);
    bool faces = (record.flags & VOXELS_SHOW_FACES) != 0 && seen.a == 1.0;
    fill_surface(record.shape, hit.normal, record.shape.material, vec4(seen.rgb * seen.rgb, 1.0),
                 faces ? 0.0 : STEPS_OFF * length(hit.normal));
    surface.geometric_normal = surface.normal;
    surface.alpha *= seen.a;
    surface.thickness = hit.error;
}
