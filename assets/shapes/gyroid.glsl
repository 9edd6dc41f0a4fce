// A ball of Schoen's gyroid, the minimal surface that parts space into two equal labyrinths, twisted round the y axis.
// Bounds: radius to all sides.

vec3 twisted(vec3 p, float twist) {
    float angle = twist * p.y;
    float c = cos(angle), s = sin(angle);
    return vec3(c * p.x - s * p.z, p.y, s * p.x + c * p.z);
}

float gyroid(vec3 p) { return dot(sin(p), cos(p.yzx)); }

// `cell`: a period of the surface, metres. `thickness`: of the wall, metres.
float distance_at(vec3 p, float radius, float cell, float thickness, float twist) {
    float frequency = 6.2831853 / cell;
    // The gyroid's slope is at most 1.74, so this is a length; the twist shears it by up to twist * radius.
    float wall = abs(gyroid(twisted(p, twist) * frequency)) / (1.74 * frequency) - 0.5 * thickness;
    float shear = 0.5 * abs(twist) * radius;
    wall /= shear + sqrt(1.0 + shear * shear);
    return max(wall, length(p) - radius);
}

// One colour for each labyrinth, and a third where the ball was cut.
vec4 color_at(vec3 p, vec3 normal, float radius, float cell, float twist, vec3 inner, vec3 outer) {
    float side = gyroid(twisted(p, twist) * 6.2831853 / cell);
    vec3 color = mix(inner, outer, smoothstep(-0.1, 0.1, side));
    float cut = smoothstep(0.995, 1.0, length(p) / radius);
    return vec4(mix(color, vec3(0.9, 0.85, 0.75), cut), 1.0);
}
