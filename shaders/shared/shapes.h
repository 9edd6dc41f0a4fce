// Shader records of procedural shapes. Each is in its shape's object space and starts with a ShapeHeader, so that what
// shapes share need not know which it is.
#ifndef FOVERAY_SHARED_SHAPES_H
#define FOVERAY_SHARED_SHAPES_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint SHAPE_SINGLE_SIDED = 1u;  // surface rays do not see it from inside

struct ShapeHeader {
    uint64_t materials;  // Material[]
    uint64_t instances;  // InstanceData[]
    uint material;
    uint shape;  // id given by the scene
    uint flags;
    uint pad;
};

struct SphereRecord {
    ShapeHeader shape;
    float radius;
    uint pad;
};

struct BoxRecord {
    ShapeHeader shape;
    vec3 half_size;
    uint pad;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(ShapeHeader) == 32 && offsetof(ShapeHeader, pad) == 28);
static_assert(sizeof(SphereRecord) == 40 && offsetof(SphereRecord, pad) == 36);
static_assert(sizeof(BoxRecord) == 48 && offsetof(BoxRecord, pad) == 44);
}  // namespace foveray::shared
#endif

#endif
