// What the passes of the history stage share: neighbours in a polar image, and whether they saw the same surface.
#ifndef FOVERAY_RENDER_HISTORY_GLSL
#define FOVERAY_RENDER_HISTORY_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "shaders/render/gaze_frame.glsl"
#include "shaders/shared/history.h"
#include "shaders/shared/light_layers.h"
#include "shaders/shared/surface.h"

uint kind_of(SampleGuide guide) { return guide.id & 3u; }

// `angular` may lie up to a turn outside.
uint sample_at(PolarMap map, uint eye, int radial, int angular) {
    int height = int(map.height);
    angular += angular < 0 ? height : angular >= height ? -height : 0;
    return (eye * map.height + uint(angular)) * map.width + uint(radial);
}

// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors": octahedral, 16 bits each.
uint pack_normal(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0) p = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
    return packSnorm2x16(p);
}

vec3 unpack_normal(uint packed_normal) {
    vec2 p = unpackSnorm2x16(packed_normal);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-n.z, 0.0);
    n.xy += mix(vec2(fold), vec2(-fold), greaterThanEqual(n.xy, vec2(0.0)));
    return normalize(n);
}

// The nearest neighbours in a polar image, almost a hexagon, with their steps from the sample.
const int NEIGHBOURS = 6;
struct Neighbourhood {
    uint index[NEIGHBOURS];
    vec2 steps[NEIGHBOURS];
};

Neighbourhood neighbourhood(PolarMap map, uint eye, ivec2 place) {
    Neighbourhood n;
    [[unroll]] for (int i = 0; i < NEIGHBOURS; ++i) {
        int ring = i < 2 ? 0 : i < 4 ? -1 : 1;
        float along = ((i & 1) == 0 ? -1.0 : 1.0) * (ring == 0 ? 1.0 : 0.5);
        int radial = clamp(place.x + ring, 0, int(map.width) - 1);
        float offset = polar_ring_start(uint(place.x)) - polar_ring_start(uint(radial));
        n.index[i] = sample_at(map, eye, radial, place.y + int(round(along + offset)));
        n.steps[i] = vec2(ring, along);
    }
    return n;
}

float sample_eccentricity(PolarMap map, uint radial) {
    return polar_eccentricity(map, (float(radial) + 0.5) * map.radius_outer / float(map.width));
}

// 0 where samples are as dense as at the gaze and the picture must stay as sharp as they are, 1 from half that density
// outwards.
float periphery(PolarMap map, float eccentricity) {
    return smoothstep(1.0, 2.0, map.cap / polar_density(map, eccentricity));
}

// The plane that a sample saw, as inverse distances round it.
struct SeenPlane {
    float inverse_distance;
    vec2 slope;  // a step along the radius, a step along the circle
    vec3 normal;
};

SeenPlane seen_plane(PolarMap map, GazeFrame gaze, uint radial, float angular, SampleGuide guide) {
    SeenPlane plane = SeenPlane(guide.inverse_distance, vec2(0.0), vec3(0.0));
    if (guide.inverse_distance == 0.0) return plane;
    float e = radians(sample_eccentricity(map, radial));
    float angle = TWO_PI * (angular + polar_ring_start(radial)) / float(map.height);
    vec3 outwards = cos(angle) * gaze.right + sin(angle) * gaze.up;
    vec3 along = cos(angle) * gaze.up - sin(angle) * gaze.right;
    vec3 direction = cos(e) * gaze.forward + sin(e) * outwards;
    vec2 step_size = vec2(radians(polar_radial_spacing(map, degrees(e))), TWO_PI / float(map.height) * sin(e));
    plane.normal = unpack_normal(guide.normal);
    // The inverse distance of a plane is linear in the direction.
    float facing = min(dot(plane.normal, direction), -0.02);
    plane.slope = guide.inverse_distance / facing * step_size *
                  vec2(dot(plane.normal, cos(e) * outwards - sin(e) * gaze.forward), dot(plane.normal, along));
    return plane;
}

// Did another sample, so many steps away, see the same surface? Normals may differ as much as a curved surface's do
// between neighbours, distances by `slack` of the distance.
bool same_surface(SeenPlane plane, uint id, vec2 steps, SampleGuide other, float slack) {
    if (other.id != id) return false;
    if (plane.inverse_distance == 0.0 || other.inverse_distance == 0.0) {
        return plane.inverse_distance == other.inverse_distance;
    }
    float expected = plane.inverse_distance + dot(plane.slope, steps);
    return abs(other.inverse_distance - expected) < slack * plane.inverse_distance &&
           dot(unpack_normal(other.normal), plane.normal) > 0.8;
}

#endif
