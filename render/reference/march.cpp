#include "render/reference/march.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foveray::reference {
namespace {

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

/// By central differences. Zero where the field is level.
dvec3 gradient(const Field& field, const dvec3& p) {
    constexpr double h = 1e-7;
    dvec3 slope(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 step(0.0);
        step[axis] = h;
        slope[axis] = field(p + step) - field(p - step);
    }
    const double length = glm::length(slope);
    return length > 0.0 ? slope / length : slope;
}

}  // namespace

std::optional<SideChange> first_side_change(const Ray& ray, const IsInside& is_inside, double step) {
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
        return SideChange{after, starts_inside};
    }
    return std::nullopt;
}

std::vector<Crossing> through_field(const Ray& ray, const Field& field, double step) {
    const IsInside is_inside = inside_of(field);
    std::vector<Crossing> result;
    Ray rest = ray;
    while (const auto change = first_side_change(rest, is_inside, step)) {
        Crossing crossing;
        crossing.distance = change->distance;
        crossing.inside = change->leaves;
        crossing.normal = gradient(field, ray.origin + change->distance * ray.direction);
        result.push_back(crossing);
        rest.nearest = change->distance;
    }
    return result;
}

bool has_both_sides(const IsInside& is_inside, const dvec3& p, double radius, int count) {
    bool any_inside = false, any_outside = false;
    for (int i = 0; i < count && !(any_inside && any_outside); ++i) {
        (is_inside(p + radius * halton_in_ball(i)) ? any_inside : any_outside) = true;
    }
    return any_inside && any_outside;
}

}  // namespace foveray::reference
