// Directions round an eye's gaze: eccentricity in degrees from its forward, angle in radians from its right,
// counter-clockwise. HERR section 3.1.
#ifndef FOVERAY_RENDER_GAZE_FRAME_GLSL
#define FOVERAY_RENDER_GAZE_FRAME_GLSL

#include "shaders/shared/sample_grid.h"

const float TWO_PI = 6.283185307179586;

vec3 polar_direction(GazeFrame gaze, float eccentricity, float angle) {
    float e = radians(eccentricity);
    return cos(e) * gaze.forward + sin(e) * (cos(angle) * gaze.right + sin(angle) * gaze.up);
}

// x: eccentricity, y: angle in [0, 2π). `direction` need not be normalised.
vec2 polar_coordinates(GazeFrame gaze, vec3 direction) {
    vec3 p = vec3(dot(direction, gaze.right), dot(direction, gaze.up), dot(direction, gaze.forward));
    float off_axis = length(p.xy);
    float angle = off_axis > 0.0 ? atan(p.y, p.x) : 0.0;
    return vec2(degrees(atan(off_axis, p.z)), angle < 0.0 ? angle + TWO_PI : angle);
}

#endif
