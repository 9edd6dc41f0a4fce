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

struct OrientedBoxRecord {
    ShapeHeader shape;
    vec3 half_size;
    uint pad;
    vec4 orientation;  // unit quaternion x, y, z, w
};

// The rectangle |x| <= half_size.x, |z| <= half_size.y of y = 0.
struct PlaneRecord {
    ShapeHeader shape;
    vec2 half_size;
    float checker_size;  // 0: no pattern
    vec3 checker_color;
};

FOVERAY_CONST uint CSG_SPHERE = 0u;
FOVERAY_CONST uint CSG_BOX = 1u;
FOVERAY_CONST uint CSG_CYLINDER = 2u;
FOVERAY_CONST uint CSG_MOST_LEAVES = 16u;
FOVERAY_CONST uint CSG_MOST_STEPS = 2u * CSG_MOST_LEAVES - 1u;  // every operation joins two
// Steps of a program in postfix order: below these, the leaf to put on the stack.
FOVERAY_CONST uint CSG_UNION = 16u;
FOVERAY_CONST uint CSG_INTERSECTION = 17u;
FOVERAY_CONST uint CSG_DIFFERENCE = 18u;

// A convex solid of unit size: radius 1, half-sizes 1.
struct CsgLeaf {
    mat4x3 leaf_from_object;
    uint kind;
    uint material;
    uint flags;  // SHAPE_SINGLE_SIDED
    uint pad;
};

struct CsgRecord {
    ShapeHeader shape;
    uint64_t leaves;  // CsgLeaf[]
    uint64_t steps;   // uint[]
    uint leaf_count;
    uint step_count;
};

// A user's own shape: the parameter block of geometry types that arrive at run time.
struct UserRecord {
    ShapeHeader shape;
    float values[16];  // in the order of the scene's parameters
    vec3 bounds_min;
    float time;  // seconds
    vec3 bounds_max;
    uint pad;
};

// The quaternions x + y i + z j that q -> q^2 + c does not drive away.
struct JuliaRecord {
    ShapeHeader shape;
    vec4 c;            // 1, i, j, k
    vec4 cut;          // unit normal and offset of the plane beyond which nothing is left; 0: no cut
    vec3 orbit_color;  // of points whose orbit stays away from the origin; those that come near keep the material's
    float radius;      // of escape
    uint iterations;
    uint pad;
};

struct MandelbulbRecord {
    ShapeHeader shape;
    vec3 orbit_color;  // as JuliaRecord's
    float power;
    float radius;  // of escape
    float far_2;   // square of the distance from which the potential is the logarithm
    uint iterations;
    uint pad;
};

FOVERAY_CONST uint BLEND_SPHERE = 0u;
FOVERAY_CONST uint BLEND_BOX = 1u;
FOVERAY_CONST uint BLEND_TORUS = 2u;
FOVERAY_CONST uint BLEND_CAPSULE = 3u;
FOVERAY_CONST uint BLEND_UNION = 0u;
FOVERAY_CONST uint BLEND_SUBTRACT = 1u;
FOVERAY_CONST uint BLEND_INTERSECT = 2u;
FOVERAY_CONST uint BLEND_MOST_PARTS = 16u;

// A solid centred at its origin, round the y axis where it has one.
struct BlendPart {
    mat4x3 part_from_object;  // shortens no more than the part's scale is uneven, lengthens nothing
    vec3 size;                // radius | half-sizes | radius of ring, of tube | radius, half-height
    uint kind;
    vec3 color;
    uint operation;  // on what the parts before it made
};

struct BlendRecord {
    ShapeHeader shape;
    uint64_t parts;  // BlendPart[]
    uint part_count;
    float smoothness;  // width over which parts flow into one another
    vec3 bounds_min;
    vec3 bounds_max;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(ShapeHeader) == 32 && offsetof(ShapeHeader, pad) == 28);
static_assert(sizeof(SphereRecord) == 40 && offsetof(SphereRecord, pad) == 36);
static_assert(sizeof(BoxRecord) == 48 && offsetof(BoxRecord, pad) == 44);
static_assert(sizeof(OrientedBoxRecord) == 64 && offsetof(OrientedBoxRecord, orientation) == 48);
static_assert(sizeof(PlaneRecord) == 56 && offsetof(PlaneRecord, checker_color) == 44);
static_assert(sizeof(CsgLeaf) == 64 && offsetof(CsgLeaf, pad) == 60);
static_assert(sizeof(CsgRecord) == 56 && offsetof(CsgRecord, step_count) == 52);
static_assert(sizeof(UserRecord) == 128 && offsetof(UserRecord, pad) == 124);
static_assert(sizeof(JuliaRecord) == 88 && offsetof(JuliaRecord, pad) == 84);
static_assert(sizeof(MandelbulbRecord) == 64 && offsetof(MandelbulbRecord, pad) == 60);
static_assert(sizeof(BlendPart) == 80 && offsetof(BlendPart, operation) == 76);
static_assert(sizeof(BlendRecord) == 72 && offsetof(BlendRecord, bounds_max) == 60);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(CsgLeafArray, CsgLeaf);
FOVERAY_ARRAY(BlendPartArray, BlendPart);
FOVERAY_ARRAY(CsgStepArray, uint);
#endif

#endif
