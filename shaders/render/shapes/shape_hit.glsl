// What the hit shaders of shapes share. Shapes are in their object space, where the ray's direction has any length: a
// distance along the ray is the same number in object and world space.
#ifndef FOVERAY_RENDER_SHAPES_SHAPE_HIT_GLSL
#define FOVERAY_RENDER_SHAPES_SHAPE_HIT_GLSL

#include "shaders/shared/shapes.h"

const uint HIT_OUTSIDE = 0u;  // hit kinds: the side that the ray comes from
const uint HIT_INSIDE = 1u;

struct ShapeHit {
    vec3 normal;   // outwards, object space, any length; zero: the closest-hit shader finds it
    float error;   // how far off the true surface the hit may be, in lengths of the ray's direction
    uint detail;   // what else the shape has to say: a material, a packed colour
};

#endif
