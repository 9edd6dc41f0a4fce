#include "render/scene/scene_material.h"

#include "render/scene/scene_animation.h"

namespace foveray::scene {

Material read_material(const SceneValues& values, const Json& json, const std::string& name,
                       const std::string& place) {
    Material m;
    m.name = name;
    if (json.contains("base_color")) {
        const Json& c = json["base_color"];
        for (std::size_t i = 0; i < c.size(); ++i) m.base_color[static_cast<int>(i)] = c[i].get<float>();
    }
    if (m.base_color.a < 1.0f) m.alpha_mode = AlphaMode::Blend;
    m.metallic = values.number(json, "metallic", place, 0.0f);
    m.roughness = values.number(json, "roughness", place, 0.5f);
    m.emissive = values.triple(json, "emissive", place, m.emissive);
    m.double_sided = json.value("double_sided", true);
    m.unlit = json.value("unlit", false);
    m.transmission = values.number(json, "transmission", place, m.transmission);
    m.ior = values.number(json, "ior", place, m.ior);
    m.solid = !json.value("thin", false);
    m.attenuation_color = values.triple(json, "attenuation_color", place, m.attenuation_color);
    m.attenuation_distance = values.number(json, "attenuation_distance", place, m.attenuation_distance);
    return m;
}

MaterialId add_material(SceneBuilder& builder, const SceneValues& values, const Json& json, Material material,
                        const std::string& place) {
    const MaterialId id = builder.add(std::move(material));
    add_material_animation(builder, values, json, place, id);
    return id;
}

}  // namespace foveray::scene
