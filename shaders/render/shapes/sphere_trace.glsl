// Sphere tracing (Hart 1996), for every shape that is told by a distance.
//
// The including shader declares its record as `record` (see intersect.glsl) and defines
//
//     float shape_distance(vec3 p);
//
// in object space, where p lies in the shape's bounds: never farther than to the nearest point of the surface, negative
// inside. A distance that changes by at most 1 a unit of p is always right. Where only the outside is known, any negative
// number of such a length does for the inside. Its main() calls sphere_trace with the part of the ray that is in the
// bounds. Hits have no normal: the closest-hit shader finds it (distance_surface.glsl).
#ifndef FOVERAY_RENDER_SHAPES_SPHERE_TRACE_GLSL
#define FOVERAY_RENDER_SHAPES_SPHERE_TRACE_GLSL

#include "shaders/render/shapes/convex.glsl"
#include "shaders/render/shapes/intersect.glsl"

float shape_distance(vec3 p);

const uint MOST_STEPS = 256u;
const float CONE_PART = 0.25;       // of the cone's width: nearer than this is on the surface
const float ROUNDING = 5e-7;        // of a point, a unit of its distance
const float EXHAUSTED_PART = 4.0;   // after the last step, of the threshold: nearer than this still counts as hit
const float FAR_OFF = 1e30;

// Bán and Valasek 2023, "Automatic Step Size Relaxation in Sphere Tracing": steps as long as they may be if the distance
// goes on to change as it did, taken back where the empty balls of two points turn out not to meet. About a fifth fewer
// steps than those of the distance itself, and half as many in the longest rays.
const float SURELY_SAFE = -1.0;     // slope of the distance along the ray: a step of the distance itself
const float STEEPEST_SLOPE = 0.75;  // no step longer than 8 times that
const float SLOPE_MEMORY = 0.3;     // weight of the last step

// The least that the instance's transform shrinks a world length by, so that a distance in object units divided by it is
// never less than one in the world. Exact where the transform is scale after rotation.
float least_object_length() {
    mat4x3 m = gl_WorldToObjectEXT;
    vec3 rows = vec3(m[0].x, m[1].x, m[2].x);
    float least = dot(rows, rows);
    rows = vec3(m[0].y, m[1].y, m[2].y);
    least = min(least, dot(rows, rows));
    rows = vec3(m[0].z, m[1].z, m[2].z);
    return sqrt(min(least, dot(rows, rows)));
}

// How far off a point at t may be, in lengths of the ray's direction: by the way to it and by the origin's digits.
float rounding_at(float t) {
    float rate = length(gl_ObjectRayDirectionEXT);
    return ROUNDING * (t + length(gl_ObjectRayOriginEXT) / rate + length(gl_WorldRayOriginEXT));
}

// A surface counts as hit where the ray comes nearer to it than the threshold, which grows with the cone. A ray that
// starts as near as that hits what it goes into and not what it leaves. True: nothing farther need be looked for.
bool sphere_trace(Span span) {
    float entry = max(span.entry, 0.0), exit = min(span.exit, gl_RayTmaxEXT);
    if (!(entry < exit)) return false;
    float rate = length(gl_ObjectRayDirectionEXT);  // object units a unit of t
    vec3 direction = gl_ObjectRayDirectionEXT / rate;
    vec3 origin = gl_ObjectRayOriginEXT + entry * gl_ObjectRayDirectionEXT;
    float length_of_way = (exit - entry) * rate;

    RayCone cone = ray_cone_of(gl_RayTminEXT);
    float part = CONE_PART * least_object_length();
    float threshold_start = part * ray_cone_width(cone, entry) + rounding_at(entry) * rate;
    float threshold_growth = part * cone.spread / rate + ROUNDING;

    float way = 0.0, step_length = 0.0, slope = SURELY_SAFE;
    bool armed = span.entry > 0.0;  // has been away from any surface: the next one counts
    float side = 1.0;               // that the ray is on; -1: inside
    float radius = FAR_OFF;         // of the empty ball round the point before
    float at_start = -FAR_OFF;      // distance, if the ray starts outside within the threshold
    for (uint i = 0; i < MOST_STEPS; ++i) {
        float distance = shape_distance(origin + way * direction);
        float threshold = threshold_start + way * threshold_growth;
        if (slope > SURELY_SAFE && side * distance + radius < step_length) {  // the two balls leave a gap
            way += radius - step_length;
            step_length = radius;
            slope = SURELY_SAFE;
            continue;
        }
        if (armed && side * distance < -threshold && step_length > threshold) {  // went through the surface: halved
            step_length *= 0.5;
            way -= step_length;
            slope = SURELY_SAFE;
            continue;
        }
        slope = armed && step_length > 0.0
                    ? min(mix(slope, (side * distance - radius) / step_length, SLOPE_MEMORY), STEEPEST_SLOPE)
                    : SURELY_SAFE;
        bool goes_in = i == 1 && distance < at_start;
        if (goes_in || (armed && side * distance < min(threshold, radius))) {
            float t = goes_in ? entry : entry + way / rate;
            if (report_surface(max(t, gl_RayTminEXT), vec3(0.0), side < 0.0, threshold / rate, 0)) return true;
            armed = false;
            slope = SURELY_SAFE;
        } else if (!armed && abs(distance) >= threshold) {
            armed = true;
            side = sign(distance);
        } else if (!armed && i == 0 && distance >= 0.0) {
            at_start = distance;
        }
        radius = abs(distance);
        if (way + max(radius, threshold) > length_of_way) return false;
        step_length = min(max(2.0 * radius / (1.0 - slope), threshold), length_of_way - way);
        way += step_length;
    }
    way -= step_length;
    float threshold = threshold_start + way * threshold_growth;
    return armed && radius < EXHAUSTED_PART * threshold &&
           report_surface(entry + way / rate, vec3(0.0), side < 0.0, threshold / rate, 0);
}

#endif
