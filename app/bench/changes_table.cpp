#include <cmath>

#include "app/bench/tables.h"
#include "render/scene/scene_builder.h"

namespace foveray::app {
namespace {

constexpr std::uint32_t side = 10;  // instances along an axis
constexpr uvec2 full_hd{1920, 1080};

enum class Motion { None, Moves, ComesAndGoes };

/// One loop of its own for each: round its place, or there for half of every 0.2 s.
void animate(scene::SceneBuilder& builder, scene::NodeId node, vec3 place, std::uint32_t number) {
    scene::AnimationChannel channel;
    channel.node = node;
    const float start = 2.0f * pi * static_cast<float>(number % 37) / 37.0f;
    for (int key = 0; key <= 8; ++key) {
        const float angle = start + 2.0f * pi * static_cast<float>(key) / 8.0f;
        channel.times.push_back(0.25f * static_cast<float>(key));
        for (const float v : {place.x + 0.1f * std::cos(angle), place.y + 0.1f * std::sin(angle), place.z})
            channel.values.push_back(v);
    }
    scene::Animation animation;
    animation.channels = {channel};
    builder.add(std::move(animation));
}

std::vector<scene::Presence> blinking(std::uint32_t number) {
    constexpr Nanoseconds half = nanoseconds_per_second / 10;
    std::vector<scene::Presence> when;
    for (Nanoseconds i = 0; i < 50; ++i)
        when.push_back({(2 * i + number % 2) * half, (2 * i + 1 + number % 2) * half});
    return when;
}

scene::Scene thousand(Motion motion) {
    scene::SceneBuilder builder;
    std::vector<scene::MeshId> meshes;
    for (std::uint32_t i = 0; i < 8; ++i) {
        scene::Material material;
        material.base_color = vec4(i & 1 ? 0.8f : 0.3f, i & 2 ? 0.8f : 0.3f, i & 4 ? 0.8f : 0.3f, 1.0f);
        material.metallic = 0.0f;
        scene::Mesh mesh = i % 2 == 0 ? scene::make_box(vec3(0.08f)) : scene::make_sphere(0.1f, 24);
        mesh.primitives[0].material = builder.add(material);
        meshes.push_back(builder.add(std::move(mesh)));
    }
    for (std::uint32_t i = 0; i < side * side * side; ++i) {
        const uvec3 cell(i % side, i / side % side, i / side / side);
        const vec3 place =
            0.4f * (vec3(cell) - 0.5f * static_cast<float>(side - 1)) + vec3(0.0f, 0.0f, -4.5f);
        scene::Node node;
        node.local.translation = place;
        node.mesh = meshes[i % meshes.size()];
        if (motion == Motion::ComesAndGoes) node.present = blinking(i);
        const scene::NodeId id = builder.add(std::move(node));
        if (motion == Motion::Moves) animate(builder, id, place, i);
    }
    scene::AreaLight lamp{"lamp", scene::AreaLightShape::Sphere, vec3(0.3f), vec3(60.0f)};
    scene::Node node;
    node.area_light = builder.add(std::move(lamp));
    node.local.translation = {2.0f, 3.0f, -1.0f};
    builder.add(std::move(node));
    return std::move(builder).build();
}

Shot every_pixel(const scene::Scene& scene) {
    Shot shot;
    shot.views = {camera_view(scene, full_hd)};
    shot.settings.shadow_samples = 1;
    shot.settings.ambient_occlusion_samples = 0;
    return shot;
}

}  // namespace

std::vector<BenchRow> changes_rows() {
    return {{"1,000 still instances", [] { return thousand(Motion::None); }, every_pixel},
            {"1,000 moving instances", [] { return thousand(Motion::Moves); }, every_pixel},
            {"1,000 that come and go", [] { return thousand(Motion::ComesAndGoes); }, every_pixel}};
}

}  // namespace foveray::app
