#include <cmath>

#include "render/scene/scene_builder.h"
#include "shaders/shared/surface.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/geometry/comparison.h"
#include "tests/render/geometry/scene_rig.h"

namespace foveray::render {
namespace {

using MaterialTest = fakes::GpuTest;
using scene::AlphaMode;

/// A rectangle that faces the viewer, its texture upright.
scene::Node upright(scene::MeshId mesh, vec3 position) {
    scene::Node node;
    node.mesh = mesh;
    node.local.rotation = glm::angleAxis(pi / 2, vec3(1, 0, 0));
    node.local.translation = position;
    return node;
}

scene::MeshId add_rectangle(scene::SceneBuilder& builder, vec2 half_size, scene::MaterialId material) {
    scene::Mesh mesh = scene::make_rectangle(half_size);
    mesh.primitives[0].material = material;
    return builder.add(std::move(mesh));
}

/// Unrelated colours and alphas, the same on every platform.
Image noise(std::uint32_t width, std::uint32_t height) {
    Image image(width, height, 4);
    std::uint32_t state = 1;
    for (auto& value : image.pixels) {
        state = state * 1664525u + 1013904223u;
        value = static_cast<std::uint8_t>(state >> 24);
    }
    return image;
}

scene::TextureId add_texture(scene::SceneBuilder& builder, Image image, scene::Sampler sampler) {
    const scene::ImageId id = builder.add(scene::TextureImage{"test", std::move(image)});
    return builder.add(scene::Texture{id, sampler});
}

scene::TextureId add_texel(scene::SceneBuilder& builder, std::array<std::uint8_t, 4> rgba) {
    Image image(1, 1, 4);
    std::copy(rgba.begin(), rgba.end(), image.pixels.begin());
    return add_texture(builder, std::move(image), {});
}

/// One pixel straight ahead.
shared::Surface look_ahead(SceneRig& rig) {
    const View view = view_forward(1.0f, {1, 1});
    return rig.surfaces(0, {&view, 1}).front();
}

TEST_F(MaterialTest, texturesAgreeWithTheReference) {
    scene::SceneBuilder builder;
    const scene::ImageId image = builder.add(scene::TextureImage{"noise", noise(8, 4)});
    using scene::Filter;
    using scene::Wrap;
    int place = 0;
    for (const Filter filter : {Filter::Nearest, Filter::Linear}) {
        for (const auto& [u, v] : {std::pair(Wrap::Repeat, Wrap::MirroredRepeat),
                                   std::pair(Wrap::MirroredRepeat, Wrap::ClampToEdge),
                                   std::pair(Wrap::ClampToEdge, Wrap::Repeat)}) {
            for (const std::uint32_t uv_set : {0u, 1u}) {
                scene::Material material;
                material.base_color = {0.9f, 0.8f, 0.7f, 1.0f};
                auto& use = material.base_color_texture;
                use.texture =
                    builder.add(scene::Texture{image, {filter, filter, scene::MipFilter::None, u, v}});
                use.uv_set = uv_set;
                use.offset = {-0.7f, -0.4f};
                use.rotation = 0.3f;
                use.scale = {2.3f, 3.1f};
                scene::Mesh mesh = scene::make_rectangle(vec2(0.45f));
                auto& primitive = mesh.primitives[0];
                primitive.material = builder.add(material);
                primitive.uv1 = {{0.1f, 0.2f}, {0.9f, -0.3f}, {0.8f, 1.2f}, {-0.2f, 0.7f}};
                if (place % 3 == 0) {
                    primitive.colors = {{1, 0, 0, 1}, {0.2f, 1, 0, 0.5f}, {0, 0.3f, 1, 1}, {1, 1, 0.5f, 0}};
                }
                builder.add(upright(
                    builder.add(std::move(mesh)),
                    {static_cast<float>(place % 4) - 1.5f, static_cast<float>(place / 4) - 1.0f, -2}));
                ++place;
            }
        }
    }
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    const View view = view_forward(45.0f, {64, 64});
    const auto found = rig.surfaces(0, {&view, 1});
    const reference::Tracer tracer(scene, rig.changes());
    const auto directions = directions_of(view);
    int compared = 0, different = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto hit = tracer.closest({.origin = dvec3(0), .direction = directions[i]});
        if (!hit || found[i].kind != shared::SURFACE_VIRTUAL) continue;
        ++compared;
        // Weights of a linear filter have eight bits; nearest texels may fall either way on their borders.
        different += glm::length(found[i].base_color - vec3(hit->base_color)) > 0.02f;
    }
    EXPECT_GT(compared, 2000);
    EXPECT_LE(different, compared / 200);
}

TEST_F(MaterialTest, alphaModesAgreeWithTheReference) {
    scene::SceneBuilder builder;
    Image image = noise(8, 8);
    for (std::size_t i = 3; i < image.pixels.size(); i += 12)
        image.pixels[i] = 0;  // some texels are not there
    const scene::TextureId texture = add_texture(
        builder, image, {scene::Filter::Nearest, scene::Filter::Nearest, scene::MipFilter::None, {}, {}});
    const std::array modes = {AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend};
    for (int i = 0; i < 3; ++i) {
        scene::Material material;
        material.alpha_mode = modes[i];
        material.alpha_cutoff = 0.6f;
        material.double_sided = i == 1;
        material.base_color_texture.texture = texture;
        const auto mesh = add_rectangle(builder, vec2(0.5f), builder.add(material));
        builder.add(upright(mesh, {static_cast<float>(i) * 1.1f - 1.1f, 0, -2}));
    }
    builder.add(upright(add_rectangle(builder, vec2(4.0f), 0), {0, 0, -3}));
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    const View view = view_forward(40.0f, {60, 60});
    const auto found = rig.surfaces(0, {&view, 1});
    const reference::Tracer tracer(scene, rig.changes());
    const auto directions = directions_of(view);
    int different = 0;
    std::array<int, 4> seen{};
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto hit = tracer.closest({.origin = dvec3(0), .direction = directions[i]});
        ASSERT_TRUE(hit);
        ++seen[hit->object];
        const bool blends = hit->object == 2;
        different += found[i].instance != hit->object ||
                     std::abs(found[i].alpha - (blends ? hit->base_color.a : 1.0f)) > 0.01f;
    }
    for (const int count : seen) EXPECT_GT(count, 20);
    EXPECT_LE(different, 10);
}

TEST_F(MaterialTest, texturesMultiplyTheirFactors) {
    scene::SceneBuilder builder;
    scene::Material material;
    material.metallic = 0.8f;
    material.roughness = 0.9f;
    material.emissive = {2, 1, 0.5f};
    material.occlusion_strength = 0.5f;
    // One image as data and as colour: each use has its own decoding.
    const scene::TextureId shared_texture = add_texel(builder, {51, 128, 64, 255});
    material.metallic_roughness_texture.texture = shared_texture;
    material.occlusion_texture.texture = shared_texture;
    material.emissive_texture.texture = shared_texture;
    material.unlit = true;
    builder.add(upright(add_rectangle(builder, vec2(1.0f), builder.add(material)), {0, 0, -2}));
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    const shared::Surface s = look_ahead(rig);
    ASSERT_EQ(s.kind, shared::SURFACE_VIRTUAL);
    EXPECT_NEAR(s.roughness, 0.9f * 128 / 255, 1e-3);
    EXPECT_NEAR(s.metallic, 0.8f * 64 / 255, 1e-3);
    EXPECT_NEAR(s.occlusion, 1.0f + 0.5f * (51.0f / 255 - 1.0f), 1e-3);
    expect_near(s.emissive,
                {2 * linear_from_srgb(51.0f / 255), linear_from_srgb(128.0f / 255),
                 0.5f * linear_from_srgb(64.0f / 255)},
                2e-3f, "emissive");
    EXPECT_EQ(s.flags, shared::SURFACE_FLAG_UNLIT);
    EXPECT_EQ(s.alpha, 1.0f);
}

TEST_F(MaterialTest, normalMapsTiltTheNormalTowardsTheTangentFrame) {
    struct Case {
        vec3 scale;
        bool from_behind, mirrored_uv;
        float normal_scale;
        vec3 expected;  // before normalising
    };
    // The texel says (0.6, 0.3, ...): to the right and, glTF's green being up, upwards.
    const vec3 texel = vec3(204, 166, 255) / 255.0f * 2.0f - 1.0f;
    const std::array<Case, 5> cases = {
        {{vec3(1), false, false, 1.0f, {texel.x, texel.y, texel.z}},
         {vec3(1), false, false, 0.5f, {0.5f * texel.x, 0.5f * texel.y, texel.z}},
         {vec3(1), false, true, 1.0f, {-texel.x, texel.y, texel.z}},
         {vec3(-1, 1, 1), false, false, 1.0f, {-texel.x, texel.y, texel.z}},
         {vec3(1), true, false, 1.0f, {texel.x, texel.y, texel.z}}}};
    scene::SceneBuilder builder;
    const scene::TextureId texture = add_texel(builder, {204, 166, 255, 255});
    for (std::size_t i = 0; i < cases.size(); ++i) {
        scene::Material material;
        material.double_sided = true;
        material.normal_scale = cases[i].normal_scale;
        material.normal_texture.texture = texture;
        scene::Mesh mesh = scene::make_rectangle(vec2(0.4f));
        mesh.primitives[0].material = builder.add(material);
        if (cases[i].mirrored_uv) {
            for (vec2& uv : mesh.primitives[0].uv0) uv.x = 1.0f - uv.x;
        }
        scene::Node node = upright(builder.add(std::move(mesh)), {static_cast<float>(i) - 2.0f, 0, -2});
        node.local.scale = cases[i].scale;
        if (cases[i].from_behind)
            node.local.rotation = glm::angleAxis(pi, vec3(0, 1, 0)) * node.local.rotation;
        builder.add(node);
    }
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    View view;
    view.fov = {-std::atan(1.25f), std::atan(1.25f), 0.01f, -0.01f};
    view.size = {5, 1};
    const auto found = rig.surfaces(0, {&view, 1});
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ASSERT_EQ(found[i].instance, i);
        vec3 expected = glm::normalize(cases[i].expected);
        if (cases[i].from_behind) {
            // Turned round y, the tangent frame's right and front point the other way; then the whole normal
            // is reversed to face the viewer.
            expected = -vec3(-expected.x, expected.y, -expected.z);
        }
        expect_near(found[i].normal, expected, 5e-3f, "normal");
        expect_near(found[i].geometric_normal, {0, 0, 1}, 1e-5f, "geometric normal");
    }
}

/// Red, green and blue stripes of 1, 4 and 16 texels: level 0 shows all, levels up to 2 green and blue, up to
/// 4 blue.
Image stripes() {
    Image image(256, 256, 4);
    for (std::uint32_t y = 0; y < 256; ++y) {
        for (std::uint32_t x = 0; x < 256; ++x) {
            std::uint8_t* p = image.at(x, y);
            p[0] = x % 2 ? 255 : 0;
            p[1] = x / 4 % 2 ? 255 : 0;
            p[2] = x / 16 % 2 ? 255 : 0;
            p[3] = 255;
        }
    }
    return image;
}

TEST_F(MaterialTest, rayConesChooseTheTexturesLevel) {
    constexpr float texels_per_metre = 128.0f;
    const View view = view_forward(1.0f, {16, 16});
    const float spread = 2.0f * std::tan(radians(1.0f)) / 16.0f;
    for (const float tilt_degrees : {0.0f, 60.0f}) {
        scene::SceneBuilder builder;
        scene::Material material;
        material.base_color_texture.texture =
            add_texture(builder, stripes(),
                        {scene::Filter::Nearest, scene::Filter::Nearest, scene::MipFilter::Nearest, {}, {}});
        material.base_color_texture.scale = vec2(50.0f);
        material.double_sided = true;
        scene::Node node = upright(add_rectangle(builder, vec2(50.0f), builder.add(material)), {0, 0, 0});
        node.local.rotation = glm::angleAxis(radians(tilt_degrees), vec3(0, 1, 0)) * node.local.rotation;
        // The view is moved instead of the plane; one texel of the level under test fills a pixel's cone.
        builder.add(node);
        const scene::Scene scene = std::move(builder).build();
        SceneRig rig(device(), scene);
        for (int level = 0; level <= 5; ++level) {
            View at = view;
            const float cosine = std::cos(radians(tilt_degrees));
            at.stage_from_eye.position = {
                0.0137f, 0, std::exp2(static_cast<float>(level)) * cosine / (texels_per_metre * spread)};
            std::array<int, 3> striped{};
            const auto found = rig.surfaces(level, {&at, 1});
            for (const shared::Surface& s : found) {
                ASSERT_EQ(s.kind, shared::SURFACE_VIRTUAL);
                for (int c = 0; c < 3; ++c) striped[c] += std::abs(s.base_color[c] - 0.5f) > 0.15f;
            }
            const auto all = static_cast<int>(found.size());
            EXPECT_EQ(striped[0], level == 0 ? all : 0) << "tilt " << tilt_degrees << " level " << level;
            EXPECT_EQ(striped[1], level <= 2 ? all : 0) << "tilt " << tilt_degrees << " level " << level;
            EXPECT_EQ(striped[2], level <= 4 ? all : 0) << "tilt " << tilt_degrees << " level " << level;
            EXPECT_NEAR(found[0].footprint, spread * found[0].distance, 0.05f * found[0].footprint);
        }
    }
}

TEST_F(MaterialTest, shadowsPassThroughHolesAndGlass) {
    scene::SceneBuilder builder;
    scene::Light light;
    light.kind = scene::LightKind::Directional;
    light.intensity = vec3(2.0f);
    scene::Node sun;
    sun.light = builder.add(light);
    sun.local.rotation =
        glm::angleAxis(-std::atan2(0.6f, 0.8f), vec3(0, 1, 0));  // shines along (0.6, 0, -0.8)
    builder.add(sun);
    scene::Material wall;
    wall.metallic = 0.0f;
    builder.add(upright(add_rectangle(builder, vec2(5.0f), builder.add(wall)), {0, 0, -4}));

    Image halves(2, 1, 4);
    halves.pixels = {255, 255, 255, 0, 255, 255, 255, 255};  // the left half is a hole
    std::array<scene::Material, 4> blockers;
    blockers[1].alpha_mode = AlphaMode::Mask;
    blockers[1].base_color_texture.texture = add_texture(
        builder, halves, {scene::Filter::Nearest, scene::Filter::Nearest, scene::MipFilter::None, {}, {}});
    blockers[2].alpha_mode = AlphaMode::Blend;
    blockers[2].base_color = {1, 1, 1, 0.25f};
    blockers[3] = blockers[2];
    blockers[3].base_color = {1, 0, 0, 0.5f};
    for (int i = 0; i < 4; ++i) {
        // Blockers at x = -1.5 throw their shadow to x = 0 of the wall; the first shows the light its back.
        const auto mesh = add_rectangle(builder, {0.3f, 0.15f}, builder.add(blockers[i]));
        scene::Node node = upright(mesh, {-1.5f, 0.9f - 0.6f * static_cast<float>(i), -2});
        if (i == 0) node.local.rotation = glm::angleAxis(pi, vec3(0, 1, 0)) * node.local.rotation;
        builder.add(node);
    }
    builder.set(scene::constant_environment(vec3(0.0f)));
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    View view;  // three columns over x = -0.2 … 0.2 and twelve rows over y = -1.2 … 1.2 of the wall
    view.fov = {-std::atan(0.075f), std::atan(0.075f), std::atan(0.3f), -std::atan(0.3f)};
    view.size = {3, 12};
    Settings settings;
    settings.reflections = false;
    settings.shadow_samples = 1;
    const auto lit = rig.picture(0, view, settings);
    settings.shadows = false;
    const auto open = rig.picture(1, view, settings);
    const auto passed = [&](int x, int y) {
        const int i = 3 * y + x;
        EXPECT_GT(open[i].g, 0.1f);
        return vec3(lit[i]) / vec3(open[i]);
    };
    expect_near(passed(1, 2), vec3(1.0f), 0.01f, "nothing in between");
    expect_near(passed(1, 1), vec3(0.0f), 0.01f, "back of a one-sided blocker");
    expect_near(passed(0, 4), vec3(1.0f), 0.01f, "hole");
    expect_near(passed(2, 4), vec3(0.0f), 0.01f, "beside the hole");
    expect_near(passed(1, 7), vec3(0.75f), 0.01f, "glass");
    expect_near(passed(1, 10), {0.5f, 0.25f, 0.25f}, 0.01f, "red glass");
}

}  // namespace
}  // namespace foveray::render
