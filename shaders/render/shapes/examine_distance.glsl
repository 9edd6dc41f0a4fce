// Compute shader: looks at a user's distance_at in and around its bounds. The bounds lie where what is inside the surface
// reaches out of them: at their faces it would be cut off, farther out it would be missing.
#include "shaders/render/shapes/examine.glsl"

float shape_distance(vec3 p);

void examine(vec3 p) {
    float distance_here = shape_distance(p);
    if (isnan(distance_here)) report_finding(FINDING_NOT_A_NUMBER, p);
    vec3 q = abs(p - 0.5 * (record.bounds_min + record.bounds_max)) / (record.bounds_max - record.bounds_min);
    bool in_reach = max(q.x, max(q.y, q.z)) < 0.5 * (1.0 - 1e-5);
    if (!in_reach && distance_here < -examination_tolerance()) report_finding(FINDING_OUTSIDE, p);
}

void main() {
    if (gl_GlobalInvocationID.x >= push.count) return;
    const uint side = EXAMINED_SIDE;
    uvec3 cell = uvec3(gl_GlobalInvocationID.x % side, gl_GlobalInvocationID.x / side % side,
                       gl_GlobalInvocationID.x / (side * side));
    vec3 size = record.bounds_max - record.bounds_min;
    vec3 part = (vec3(cell) + 0.5) / float(side);
    // Twice as large as the bounds, and in the first layers of cells their six faces.
    examine(record.bounds_min + (2.0 * part - 0.5) * size);
    if (cell.z < 6) {
        vec3 face = vec3(0.0);
        uint axis = cell.z >> 1;
        face[axis] = float(cell.z & 1);
        vec2 across = vec2(cell.xy) / float(side - 1);
        face[(axis + 1) % 3] = across.x;
        face[(axis + 2) % 3] = across.y;
        examine(record.bounds_min + face * size);
    }
}
