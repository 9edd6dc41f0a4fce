// Ray types, masks and the hit-record formula. docs/architecture.md, "A shader table"; Proceduray section 4.
#ifndef FOVERAY_SHARED_RAY_TYPES_H
#define FOVERAY_SHARED_RAY_TYPES_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint RAY_SURFACE = 0u;  // finds the nearest surface; payload 0: Surface
FOVERAY_CONST uint RAY_SHADOW = 1u;   // finds what light gets through; payload 1: vec3 transmittance
FOVERAY_CONST uint RAY_TYPE_COUNT = 2u;

// Instance masks.
FOVERAY_CONST uint MASK_VIRTUAL = 1u;
FOVERAY_CONST uint MASK_REAL = 2u;  // catchers: invisible stand-ins of real surfaces
FOVERAY_CONST uint MASK_MOVING = 4u;
FOVERAY_CONST uint MASK_ALL = 0xFFu;

// Goes into instanceShaderBindingTableRecordOffset.
FOVERAY_INLINE uint instance_record_offset(uint geometries_before, uint ray_type_count) {
    return ray_type_count * geometries_before;
}

// Index of a hit record in the table. Vulkan adds the parts itself when sbtRecordOffset = ray type and
// sbtRecordStride = ray type count in traceRayEXT.
FOVERAY_INLINE uint hit_record_index(uint instance_offset, uint geometry_index, uint ray_type, uint ray_type_count) {
    return instance_offset + ray_type_count * geometry_index + ray_type;
}

FOVERAY_SHARED_END

#endif
