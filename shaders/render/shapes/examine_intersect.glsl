// Compute shader: sends rays at a user's intersect, from all around and from inside its bounds, in a space larger than they.
#include "shaders/render/shapes/examine.glsl"

bool shape_intersect(vec3 origin, vec3 direction, float t_min, float t_max, out float t, out vec3 normal);

// Points in the unit cube, evenly spread (Roberts 2018, the generalised golden ratio in three dimensions).
vec3 spread(float i) { return fract(0.5 + i * vec3(0.8191725134, 0.6710436067, 0.5497004779)); }

bool examine(vec3 origin, vec3 direction, float t_min, float t_max, out float t) {
    vec3 normal;
    if (!shape_intersect(origin, direction, t_min, t_max, t, normal)) return false;
    vec3 p = origin + t * direction;
    if (!is_number(t) || !is_number(normal)) {
        report_finding(FINDING_NOT_A_NUMBER, origin);
    } else if (!(t >= t_min && t <= t_max)) {
        report_finding(FINDING_WRONG_T, p);
    } else if (!(dot(normal, normal) > 0.0)) {
        report_finding(FINDING_NO_NORMAL, p);
    } else if (is_outside(p)) {
        report_finding(FINDING_OUTSIDE, p);
    } else {
        return true;
    }
    return false;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    vec3 size = record.bounds_max - record.bounds_min;
    float reach = length(size);
    vec3 target = record.bounds_min + spread(float(i)) * size;
    vec2 around = spread(float(i)).yz * vec2(2.0, 6.28318531) - vec2(1.0, 0.0);
    vec3 way = vec3(sqrt(1.0 - around.x * around.x) * vec2(cos(around.y), sin(around.y)), around.x);
    vec3 origin = i % 2 == 0 ? target - 2.0 * reach * way : target;
    float t;
    if (!examine(origin, way, 0.0, 4.0 * reach, t)) return;
    // The next surface behind the first, as shadow rays and single-sided materials ask for it.
    examine(origin, way, t + 1e-3 * reach, 4.0 * reach, t);
}
