#include "render/reference/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace foveray::reference {
namespace {

constexpr double off_the_surface = 1e-5;  // metres
constexpr std::uint32_t certain_bounces = 3;

/// Cosine-distributed round the normal, from a point of the unit square (Malley's method).
dvec3 cosine_direction(dvec3 normal, double u, double v) {
    const dvec3 side = glm::normalize(
        glm::cross(normal, std::abs(normal.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0)));
    const double radius = std::sqrt(u), angle = 2.0 * std::numbers::pi * v;
    return glm::normalize(radius * std::cos(angle) * side +
                          radius * std::sin(angle) * glm::cross(side, normal) + std::sqrt(1.0 - u) * normal);
}

}  // namespace

struct PathTracer::Random {
    std::mt19937 engine;
    double next() { return static_cast<double>(engine()) / 4294967296.0; }
};

PathTracer::PathTracer(const scene::Scene& scene, const scene::SceneChanges& now)
    : scene_(&scene), lights_(now.area_lights), tracer_(scene, now) {}

dvec3 PathTracer::environment(dvec3 direction) const {
    const scene::Environment& environment = scene_->environment;
    const vec2 uv = scene::environment_uv(environment, vec3(direction));
    const FloatImage& picture = environment.radiance;
    const auto texel = [](float at, std::uint32_t size) {
        return std::min(static_cast<std::uint32_t>(std::max(at, 0.0f) * static_cast<float>(size)), size - 1);
    };
    const float* p = picture.at(texel(uv.x, picture.width), texel(uv.y, picture.height));
    return double{environment.intensity} * dvec3(p[0], p[1], p[2]);
}

dvec3 PathTracer::direct_irradiance(dvec3 position, dvec3 normal, Random& random) const {
    dvec3 sum(0.0);
    for (const scene::PlacedAreaLight& light : lights_) {
        const dvec3 u(light.half_u), v(light.half_v);
        const double a = 2.0 * random.next() - 1.0, b = 2.0 * random.next() - 1.0;
        const dvec3 way = dvec3(light.center) + a * u + b * v - position;
        const dvec3 facing = 4.0 * glm::cross(u, v);  // as long as the light is large
        const double distance_2 = glm::dot(way, way);
        const double factor = std::max(glm::dot(normal, way), 0.0) * std::max(-glm::dot(facing, way), 0.0) /
                              (distance_2 * distance_2);
        if (factor == 0.0) continue;
        const double through = tracer_.transmittance({position + off_the_surface * normal, way, 0.0, 0.9999});
        sum += factor * through * dvec3(light.radiance);
    }
    return sum;
}

dvec3 PathTracer::radiance(Ray ray, Random& random) const {
    dvec3 sum(0.0), weight(1.0);
    for (std::uint32_t bounce = 0;; ++bounce) {
        const std::optional<Hit> hit = tracer_.closest(ray, Side::FrontOnly);
        if (!hit) return sum + weight * environment(ray.direction);
        const scene::Material& material = scene_->materials[hit->material];
        const dvec3 normal = (hit->front ? 1.0 : -1.0) * dvec3(hit->shading_normal);
        sum += weight * dvec3(material.emissive);
        weight *= dvec3(hit->base_color) * (1.0 - double{material.metallic});
        sum += weight * direct_irradiance(hit->position, normal, random) / std::numbers::pi;
        if (bounce >= certain_bounces) {
            const double survives = std::min(std::max({weight.x, weight.y, weight.z}), 0.95);
            if (random.next() >= survives) return sum;
            weight /= survives;
        }
        const double u = random.next(), v = random.next();
        ray = Ray{hit->position + off_the_surface * normal, cosine_direction(normal, u, v)};
    }
}

dvec3 PathTracer::indirect_irradiance(dvec3 position, dvec3 normal, std::uint32_t paths) const {
    Random random;
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(paths))));
    dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const double u = (i % side + random.next()) / side, v = (i / side + random.next()) / side;
        sum += radiance({position + off_the_surface * normal, cosine_direction(normal, u, v)}, random);
    }
    return std::numbers::pi * sum / static_cast<double>(side * side);
}

}  // namespace foveray::reference
