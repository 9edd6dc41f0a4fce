// Where a line passes through convex solids that are centred at the origin.
#ifndef FOVERAY_RENDER_SHAPES_CONVEX_GLSL
#define FOVERAY_RENDER_SHAPES_CONVEX_GLSL

struct Span {
    float entry, exit;  // entry > exit: it misses
};

const Span NO_SPAN = Span(1.0, -1.0);

// No component is zero, so that a line within a slab's plane gives large numbers and no NaN.
vec3 divisible(vec3 direction) { return mix(direction, vec3(1e-30), lessThan(abs(direction), vec3(1e-30))); }

// Kay and Kajiya 1986: the distances to the slabs of a box.
void slab_distances(vec3 half_size, vec3 origin, vec3 direction, out vec3 entries, out vec3 exits) {
    vec3 inverse = 1.0 / divisible(direction);
    vec3 a = (-half_size - origin) * inverse, b = (half_size - origin) * inverse;
    entries = min(a, b);
    exits = max(a, b);
}

float largest(vec3 v) { return max(v.x, max(v.y, v.z)); }
float smallest(vec3 v) { return min(v.x, min(v.y, v.z)); }

Span box_span(vec3 half_size, vec3 origin, vec3 direction) {
    vec3 entries, exits;
    slab_distances(half_size, origin, direction, entries, exits);
    return Span(largest(entries), smallest(exits));
}

// Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection" (Ray Tracing Gems, chapter 7): from the
// point nearest to the centre, so that far and large spheres lose no digits.
Span sphere_span(float radius, vec3 origin, vec3 direction) {
    float a = dot(direction, direction);
    float nearest = -dot(origin, direction) / a;
    vec3 offset = origin + nearest * direction;
    float inside_2 = radius * radius - dot(offset, offset);
    if (!(inside_2 > 0.0)) return NO_SPAN;
    float half_chord = sqrt(inside_2 / a);
    return Span(nearest - half_chord, nearest + half_chord);
}

// Round the y axis, of radius 1 and half-height 1.
Span cylinder_span(vec3 origin, vec3 direction) {
    float inverse = 1.0 / divisible(direction).y;
    float a = (-1.0 - origin.y) * inverse, b = (1.0 - origin.y) * inverse;
    Span caps = Span(min(a, b), max(a, b));
    vec2 o = origin.xz, d = direction.xz;
    if (dot(d, d) < 1e-12 * dot(direction, direction)) return dot(o, o) < 1.0 ? caps : NO_SPAN;
    Span tube = sphere_span(1.0, vec3(o.x, 0.0, o.y), vec3(d.x, 0.0, d.y));
    return Span(max(caps.entry, tube.entry), min(caps.exit, tube.exit));
}

#endif
