// Visual-polar space: HERR section 3.2, eq. 1, with the display's own density as a cap. Degrees of eccentricity.
#ifndef FOVERAY_SHARED_POLAR_H
#define FOVERAY_SHARED_POLAR_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

// Density ppd(e) = min(cap, a / (e + b)). The radial coordinate R(e) is its integral from 0, in samples at scale 1.
struct PolarMap {
    float a;
    float b;
    float cap;
    float outer;       // degrees, where the pattern ends
    uint width;        // radial samples
    uint height;       // angular samples
    float knee;        // degrees: the cap holds up to here
    float radius_knee;   // R(knee)
    float radius_outer;  // R(outer)
};

FOVERAY_INLINE float polar_density(PolarMap map, float eccentricity) {
    float d = map.a / (eccentricity + map.b);
    return d < map.cap ? d : map.cap;
}

// R(e): samples between the gaze and e at scale 1.
FOVERAY_INLINE float polar_radius(PolarMap map, float eccentricity) {
#ifdef __cplusplus
    using std::log;
#endif
    return eccentricity <= map.knee
               ? map.cap * eccentricity
               : map.radius_knee + map.a * log((eccentricity + map.b) / (map.knee + map.b));
}

FOVERAY_INLINE float polar_eccentricity(PolarMap map, float radius) {
#ifdef __cplusplus
    using std::exp;
#endif
    return radius <= map.radius_knee
               ? radius / map.cap
               : (map.knee + map.b) * exp((radius - map.radius_knee) / map.a) - map.b;
}

// Distance between neighbouring samples in degrees: the map's Jacobian, along the radius and along the circle.
FOVERAY_INLINE float polar_radial_spacing(PolarMap map, float eccentricity) {
    return map.radius_outer / (float(map.width) * polar_density(map, eccentricity));
}

FOVERAY_INLINE float polar_angular_spacing(PolarMap map, float eccentricity) {
#ifdef __cplusplus
    using std::sin;
#endif
    return 360.0f / float(map.height) * sin(eccentricity * 0.017453292519943295f);
}

// Where the first sample of a ring stands, in angular samples: neighbouring rings are half a sample apart, so that
// samples stand in quincunx and an edge along the radius is met at twice as many places.
FOVERAY_INLINE float polar_ring_start(uint radial) { return (radial & 1u) == 0u ? 0.25f : 0.75f; }

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(PolarMap) == 36 && offsetof(PolarMap, radius_outer) == 32);
}  // namespace foveray::shared
#endif

#endif
