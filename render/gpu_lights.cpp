#include "render/gpu_lights.h"

namespace foveray::render {
namespace {

std::uint32_t type_of(scene::LightKind kind) {
    switch (kind) {
        case scene::LightKind::Directional:
            return shared::LIGHT_DIRECTIONAL;
        case scene::LightKind::Point:
            return shared::LIGHT_POINT;
        case scene::LightKind::Spot:
            return shared::LIGHT_SPOT;
    }
    return shared::LIGHT_POINT;
}

shared::Light packed(const scene::PlacedAreaLight& light) {
    shared::Light packed{};
    packed.position = light.center;
    packed.intensity = light.radiance;
    packed.half_u = light.half_u;
    packed.half_v = light.half_v;
    packed.number = light.number;
    switch (light.shape) {
        case scene::AreaLightShape::Rectangle:
            packed.type = shared::LIGHT_RECTANGLE;
            packed.direction = glm::normalize(glm::cross(light.half_u, light.half_v));
            break;
        case scene::AreaLightShape::Box:
            packed.type = shared::LIGHT_BOX;
            packed.range = glm::length(light.half_w);
            packed.direction = light.half_w / packed.range;
            break;
        case scene::AreaLightShape::Sphere:
            packed.type = shared::LIGHT_SPHERE;
            packed.range = glm::length(light.half_u);
            break;
    }
    return packed;
}

}  // namespace

std::vector<shared::Light> pack_lights(const scene::SceneChanges& changes) {
    std::vector<shared::Light> result;
    for (const scene::PlacedAreaLight& light : changes.area_lights) result.push_back(packed(light));
    for (const scene::PlacedLight& light : changes.lights) {
        shared::Light packed{};
        packed.position = light.position;
        packed.type = type_of(light.kind);
        packed.direction = light.direction;
        packed.range = light.range;
        packed.intensity = light.intensity;
        packed.cos_inner = light.cos_inner_cone;
        packed.cos_outer = light.cos_outer_cone;
        packed.number = light.number;
        result.push_back(packed);
    }
    return result;
}

}  // namespace foveray::render
