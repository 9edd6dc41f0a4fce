// The rays of one sample, one after the other: straight on through see-through surfaces, mirrored, refracted. A ray
// that is found worth it waits in a short list, so that one place traces and one place shades. The including shader
// has `push` (LightingPush).
#ifndef FOVERAY_RENDER_LIGHT_PATH_GLSL
#define FOVERAY_RENDER_LIGHT_PATH_GLSL

#include "shaders/render/log_rays.glsl"
#include "shaders/render/optics.glsl"
#include "shaders/render/surface_sides.glsl"
#include "shaders/render/trace_surface.glsl"
#include "shaders/render/vectors.glsl"

// How a ray's light reaches the viewer.
const uint PATH_SEEN = 0;    // straight, through see-through surfaces at most
const uint PATH_SECOND = 1;  // over a reflection or refraction
const uint PATH_ADDED = 2;   // over a mirror image on a real surface

const uint NO_MEDIUM = 0xFFFFFFFFu;

struct Path {
    vec3 direction;
    vec3 weight;      // what the radiance that comes along it counts for
    float spread;     // of its cone
    float roughness;  // of the roughest mirror on the way
    uint kind;
    uint depth;       // reflections and refractions on the way
    uint medium;      // the material that it is inside of, or NO_MEDIUM
};

struct WaitingRay {
    Path path;
    vec3 origin;
    float width;  // of the cone at the origin
};

// Light that counts for less is not worth a ray: half a step of an 8-bit display.
const float LEAST_WEIGHT = 0.5 / 255.0;
const uint MOST_WAITING = 4;
const float FARTHEST = 1e6;

WaitingRay waiting[MOST_WAITING];
uint waiting_count = 0;

bool trace_later(Path path, vec3 origin, float width, uint room) {
    if (greatest(path.weight) <= LEAST_WEIGHT || waiting_count == room) return false;
    waiting[waiting_count++] = WaitingRay(path, origin, width);
    return true;
}

// The last that was put there: a path straight on is followed to its end first.
Surface trace_waiting(out Path path, out vec3 origin) {
    WaitingRay next = waiting[--waiting_count];
    path = next.path;
    origin = next.origin;
    uint mask = path.kind == PATH_ADDED ? MASK_VIRTUAL : MASK_ALL;
    uint faces = path.medium == NO_MEDIUM ? SEE_FRONT_FACES : SEE_BOTH_FACES;
    RayCone cone = RayCone(next.width, path.spread);
    log_ray(faces, mask, origin, path.direction, FARTHEST, cone);
    return trace_surface(mask, faces, origin, path.direction, FARTHEST, cone);
}

// Straight on; there is always room for it.
bool pass_later(Surface surface, Path path, vec3 passed) {
    path.weight *= passed;
    return trace_later(path, behind_surface(surface, path.direction), surface.footprint, MOST_WAITING);
}

bool second_later(Surface surface, Path path, vec3 origin, vec3 weight, float roughness) {
    if (path.depth == push.second_ray_depth) return false;
    path.weight = weight;
    path.kind = max(path.kind, PATH_SECOND);
    ++path.depth;
    path.spread += roughness * roughness;
    path.roughness = max(path.roughness, roughness);
    return trace_later(path, origin, surface.footprint, MOST_WAITING - 1);
}

float traced_part(float roughness) {
    if ((push.flags & LIGHTING_REFLECTIONS) == 0) return 0.0;
    float limit = push.reflection_max_roughness;
    return limit > 0.0 ? 1.0 - smoothstep(0.6 * limit, limit, roughness) : 0.0;
}

// Returns the part of the mirror image that is not traced.
float mirror_later(Surface surface, Path path, vec3 direction, vec3 weight) {
    float traced = traced_part(surface.roughness);
    path.direction = direction;
    if (traced == 0.0) return 1.0;
    bool waits = second_later(surface, path, above_surface(surface), traced * weight, surface.roughness);
    return waits ? 1.0 - traced : 1.0;
}

// Light that enters a body goes on in it; through a thin sheet, straight on. False: it is not traced.
bool refract_later(Surface surface, Optics optics, Path path, vec3 weight) {
    if (optics.solid) {
        path.direction = refract(path.direction, surface.normal, 1.0 / optics.ior);
        path.medium = surface.material;
    }
    return second_later(surface, path, below_surface(surface), weight, surface.roughness);
}

// A ray inside a body has met its surface from within: out, or back where all light is reflected.
void leave_later(Surface surface, Optics optics, Path path) {
    vec3 refracted = refract(path.direction, surface.normal, optics.ior);
    bool leaves = refracted != vec3(0.0);
    path.direction = leaves ? refracted : reflect(path.direction, surface.normal);
    if (leaves) path.medium = NO_MEDIUM;
    trace_later(path, leaves ? below_surface(surface) : above_surface(surface), surface.footprint, MOST_WAITING);
}

#endif
