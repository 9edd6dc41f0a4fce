#include "render/reference/fields.h"

#include <algorithm>
#include <cmath>

namespace foveray::reference {
namespace {

constexpr double far_off = 1e6;  // nothing comes back from there

double part_distance(const scene::BlendPart& part, const dvec3& object_p) {
    const glm::dmat4 part_from_object = glm::inverse(glm::dmat4(to_matrix(part.object_from_part)));
    const dvec3 p(part_from_object * glm::dvec4(object_p, 1.0));
    const dvec3 size(part.size), scale(part.object_from_part.scale);
    const double least = std::min({scale.x, scale.y, scale.z});
    switch (part.primitive) {
        case scene::BlendPrimitive::Box: {
            const dvec3 beyond = scale * (glm::abs(p) - size);
            const double inside = std::min(0.0, std::max({beyond.x, beyond.y, beyond.z}));
            return glm::length(glm::max(beyond, dvec3(0.0))) + inside;
        }
        case scene::BlendPrimitive::Torus: {
            const double from_ring = std::hypot(p.x, p.z) - size.x;
            return least * (std::hypot(from_ring, p.y) - size.y);
        }
        case scene::BlendPrimitive::Capsule: {
            const dvec3 on_axis(0.0, std::clamp(p.y, -size.y, size.y), 0.0);
            return least * (glm::distance(p, on_axis) - size.x);
        }
        case scene::BlendPrimitive::Sphere:
            break;
    }
    return least * (glm::length(p) - size.x);
}

/// The smaller of the two, and where they differ by less than k, a parabola below it.
double smooth_min(double a, double b, double k) {
    const double apart = std::abs(a - b);
    return std::min(a, b) - (apart < k ? (k - apart) * (k - apart) / (4.0 * k) : 0.0);
}

struct Joined {
    double distance = 0.0;
    double part_share = 0.0;  // of the colour
};

/// Intersecting and subtracting are uniting the complements.
Joined join(double before, double part, scene::BlendOperation operation, double k) {
    const bool unites = operation == scene::BlendOperation::Union;
    const double a = unites ? before : -before;
    const double b = operation == scene::BlendOperation::Intersect ? -part : part;
    const double near = k > 0.0 ? std::max(0.0, 1.0 - std::abs(a - b) / k) : 0.0;
    const double lesser_share = 0.5 * near * near;
    return {(unites ? 1.0 : -1.0) * smooth_min(a, b, k), a < b ? lesser_share : 1.0 - lesser_share};
}

double blend_distance(std::span<const scene::BlendPart> parts, double smoothness, const dvec3& p) {
    double distance = part_distance(parts.front(), p);
    for (const scene::BlendPart& part : parts.subspan(1)) {
        distance = join(distance, part_distance(part, p), part.operation, smoothness).distance;
    }
    return distance;
}

struct Orbit {
    double last = 0.0;   // how far the last point is from the origin
    double least = 0.0;  // of all points
};

Orbit orbit_of(const scene::Julia& julia, const dvec3& p) {
    const dvec3 c(julia.c.y, julia.c.z, julia.c.w);
    double real = p.x;
    dvec3 imaginary(p.y, p.z, 0.0);
    Orbit orbit{glm::length(p), glm::length(p)};
    for (std::uint32_t i = 0; i < julia.iterations && orbit.last < far_off; ++i) {
        const double next = real * real - glm::dot(imaginary, imaginary) + double{julia.c.x};
        imaginary = 2.0 * real * imaginary + c;
        real = next;
        orbit.last = std::sqrt(real * real + glm::dot(imaginary, imaginary));
        orbit.least = std::min(orbit.least, orbit.last);
    }
    return orbit;
}

Orbit orbit_of(const scene::Mandelbulb& mandelbulb, const dvec3& c) {
    const double n = mandelbulb.power;
    dvec3 z = c;
    Orbit orbit{glm::length(c), glm::length(c)};
    for (std::uint32_t i = 0; i < mandelbulb.iterations && orbit.last < far_off; ++i) {
        const double polar = n * std::atan2(std::hypot(z.x, z.z), z.y);
        const double azimuth = n * std::atan2(z.x, z.z);
        z = std::pow(orbit.last, n) * dvec3(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                            std::sin(polar) * std::cos(azimuth)) +
            c;
        orbit.last = glm::length(z);
        orbit.least = std::min(orbit.least, orbit.last);
    }
    return orbit;
}

vec3 tint(vec3 orbit_color, double part) {
    return glm::mix(vec3(1.0f), orbit_color, static_cast<float>(std::clamp(part, 0.0, 1.0)));
}

}  // namespace

Field field_of(const scene::Julia& julia) {
    return [julia](const dvec3& p) {
        const double beyond = orbit_of(julia, p).last - double{julia.radius()};
        if (julia.cut_normal == vec3(0.0f)) return beyond;
        return std::max(beyond, glm::dot(dvec3(julia.cut_normal), p) - double{julia.cut_offset});
    };
}

Field field_of(const scene::Mandelbulb& mandelbulb) {
    return
        [mandelbulb](const dvec3& p) { return orbit_of(mandelbulb, p).last - double{mandelbulb.radius()}; };
}

Field field_of(std::span<const scene::BlendPart> parts, double smoothness) {
    return [kept = std::vector(parts.begin(), parts.end()), smoothness](const dvec3& p) {
        return blend_distance(kept, smoothness, p);
    };
}

IsInside inside_of(Field field) {
    return [field = std::move(field)](const dvec3& p) { return field(p) <= 0.0; };
}

vec3 tint_of(const scene::Julia& julia, const dvec3& p) {
    return tint(julia.orbit_color, orbit_of(julia, p).least);
}

vec3 tint_of(const scene::Mandelbulb& mandelbulb, const dvec3& p) {
    return tint(mandelbulb.orbit_color, 2.0 * orbit_of(mandelbulb, p).least - 1.0);
}

vec3 tint_of(std::span<const scene::BlendPart> parts, double smoothness, const dvec3& p) {
    double distance = part_distance(parts.front(), p);
    vec3 color = parts.front().color;
    for (const scene::BlendPart& part : parts.subspan(1)) {
        const Joined joined = join(distance, part_distance(part, p), part.operation, smoothness);
        color = glm::mix(color, part.color, static_cast<float>(joined.part_share));
        distance = joined.distance;
    }
    return color;
}

}  // namespace foveray::reference
