#include "tests/render/light/clutter_scene.h"

#include <cmath>
#include <random>

#include "tests/render/light/light_rig.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

/// Octaves of blocks with smooth and hard borders, tileable.
scene::TextureImage noise_image(std::mt19937& random) {
    constexpr std::uint32_t size = 512;
    Image image(size, size, 4);
    std::vector<vec3> sum(size * size, vec3(0.0f));
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (std::uint32_t cells = 4; cells <= size; cells *= 2) {
        std::vector<vec3> values(cells * cells);
        for (vec3& value : values) value = vec3(unit(random), unit(random), unit(random)) - 0.5f;
        const bool smooth = unit(random) < 0.5f;
        const float weight = 1.2f / std::sqrt(static_cast<float>(cells));
        for (std::uint32_t y = 0; y < size; ++y) {
            for (std::uint32_t x = 0; x < size; ++x) {
                const vec2 p = vec2(x, y) * (static_cast<float>(cells) / size);
                const auto at = [&](std::uint32_t i, std::uint32_t j) {
                    return values[(j % cells) * cells + i % cells];
                };
                const auto i = static_cast<std::uint32_t>(p.x), j = static_cast<std::uint32_t>(p.y);
                vec2 f = smooth ? glm::fract(p) : vec2(0.0f);
                f = f * f * (3.0f - 2.0f * f);
                sum[y * size + x] += weight * glm::mix(glm::mix(at(i, j), at(i + 1, j), f.x),
                                                       glm::mix(at(i, j + 1), at(i + 1, j + 1), f.x), f.y);
            }
        }
    }
    for (std::uint32_t i = 0; i < size * size; ++i) {
        for (int c = 0; c < 3; ++c) {
            image.pixels[4 * i + c] =
                static_cast<std::uint8_t>(std::clamp(0.5f + sum[i][c], 0.0f, 1.0f) * 255.0f + 0.5f);
        }
        image.pixels[4 * i + 3] = 255;
    }
    return {"noise", std::move(image)};
}

}  // namespace

scene::Scene clutter_scene(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    TestScene world(vec3(0.3f, 0.35f, 0.4f));
    std::vector<scene::TextureId> textures;
    for (int i = 0; i < 4; ++i)
        textures.push_back(world.builder.add(scene::Texture{world.builder.add(noise_image(random)), {}}));
    const auto material = [&](float repeat) {
        scene::Material m = matte(vec3(0.4f) + 0.6f * vec3(unit(random), unit(random), unit(random)));
        m.roughness = 0.3f + 0.7f * unit(random);
        m.base_color_texture.texture = textures[static_cast<std::size_t>(4.0f * unit(random)) % 4];
        m.base_color_texture.scale = vec2(repeat);
        return m;
    };
    world.add(scene::make_box({12.0f, 12.0f, 0.1f}), material(6.0f), {.position = {0.0f, 0.0f, -6.0f}});
    std::vector<scene::MeshId> meshes;
    for (int i = 0; i < 24; ++i) {
        scene::Mesh mesh = i % 3 == 0
                               ? scene::make_sphere(0.7f, 16)
                               : scene::make_box(0.15f + vec3(unit(random), unit(random), unit(random)));
        mesh.primitives[0].material = world.builder.add(material(1.0f));
        meshes.push_back(world.builder.add(std::move(mesh)));
    }
    for (int i = 0; i < 4000; ++i) {
        const float distance = 1.5f + 4.0f * unit(random);
        scene::Node node;
        node.mesh = meshes[static_cast<std::size_t>(24.0f * unit(random)) % 24];
        node.local.translation =
            distance * vec3(2.0f * unit(random) - 1.0f, 2.0f * unit(random) - 1.0f, -1.0f);
        // Most things are small: sizes spread evenly over 1.5 decades of area.
        node.local.scale = vec3(0.004f * distance * std::pow(6.0f, unit(random)));
        const vec3 axis = glm::normalize(vec3(unit(random), unit(random), unit(random)) - 0.5f);
        node.local.rotation = glm::angleAxis(6.0f * unit(random), axis);
        world.builder.add(std::move(node));
    }
    world.add(scene::Light{"sun", scene::LightKind::Directional, vec3(2.0f)},
              look_at({1.0f, 2.0f, 1.5f}, vec3(0.0f)));
    return world.build();
}

}  // namespace foveray::render
