#include "render/reference/march.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foveray::reference {
namespace {

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

dvec3 halton_in_ball(int i) {
    const auto radical_inverse = [i](int base) {
        double result = 0.0, digit = 1.0 / base;
        for (int rest = i + 1; rest > 0; rest /= base, digit /= base) result += digit * (rest % base);
        return result;
    };
    const double height = 2.0 * radical_inverse(2) - 1.0;
    const double round = 2.0 * std::numbers::pi * radical_inverse(3);
    const double across = std::sqrt(1.0 - height * height);
    return std::cbrt(radical_inverse(5)) * dvec3(across * std::cos(round), across * std::sin(round), height);
}

}  // namespace

IsInside inside_of(const scene::Julia& julia) {
    return [julia](const dvec3& p) {
        if (glm::dot(dvec3(julia.cut_normal), p) > julia.cut_offset) return false;
        const double radius = julia.radius();
        const dvec3 c(julia.c.y, julia.c.z, julia.c.w);
        double real = p.x;
        dvec3 imaginary(p.y, p.z, 0.0);
        for (std::uint32_t i = 0; i < julia.iterations; ++i) {
            if (real * real + glm::dot(imaginary, imaginary) > radius * radius) return false;
            const double next = real * real - glm::dot(imaginary, imaginary) + julia.c.x;
            imaginary = 2.0 * real * imaginary + c;
            real = next;
        }
        return real * real + glm::dot(imaginary, imaginary) <= radius * radius;
    };
}

IsInside inside_of(const scene::Mandelbulb& mandelbulb) {
    return [mandelbulb](const dvec3& c) {
        const double radius = mandelbulb.radius(), n = mandelbulb.power;
        dvec3 z = c;
        for (std::uint32_t i = 0; i < mandelbulb.iterations; ++i) {
            const double r = glm::length(z);
            if (r > radius) return false;
            const double polar = n * std::atan2(std::hypot(z.x, z.z), z.y);
            const double azimuth = n * std::atan2(z.x, z.z);
            z = std::pow(r, n) * dvec3(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                       std::sin(polar) * std::cos(azimuth)) +
                c;
        }
        return glm::length(z) <= radius;
    };
}

double blend_distance(std::span<const scene::BlendPart> parts, double smoothness, const dvec3& p) {
    double distance = part_distance(parts.front(), p);
    for (const scene::BlendPart& part : parts.subspan(1)) {
        const double other = part_distance(part, p);
        switch (part.operation) {
            case scene::BlendOperation::Union:
                distance = smooth_min(distance, other, smoothness);
                break;
            case scene::BlendOperation::Subtract:
                distance = -smooth_min(-distance, other, smoothness);
                break;
            case scene::BlendOperation::Intersect:
                distance = -smooth_min(-distance, -other, smoothness);
                break;
        }
    }
    return distance;
}

IsInside inside_of(std::span<const scene::BlendPart> parts, double smoothness) {
    return [kept = std::vector(parts.begin(), parts.end()), smoothness](const dvec3& p) {
        return blend_distance(kept, smoothness, p) <= 0.0;
    };
}

std::optional<Crossing> first_crossing(const Ray& ray, const IsInside& is_inside, double step) {
    const auto inside_at = [&](double t) { return is_inside(ray.origin + t * ray.direction); };
    const bool starts_inside = inside_at(ray.nearest);
    double before = ray.nearest;
    while (before < ray.farthest) {
        double after = std::min(before + step, ray.farthest);
        if (inside_at(after) == starts_inside) {
            before = after;
            continue;
        }
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (before + after);
            (inside_at(middle) == starts_inside ? before : after) = middle;
        }
        return Crossing{after, starts_inside};
    }
    return std::nullopt;
}

bool has_both_sides(const IsInside& is_inside, const dvec3& p, double radius, int count) {
    bool any_inside = false, any_outside = false;
    for (int i = 0; i < count && !(any_inside && any_outside); ++i) {
        (is_inside(p + radius * halton_in_ball(i)) ? any_inside : any_outside) = true;
    }
    return any_inside && any_outside;
}

}  // namespace foveray::reference
