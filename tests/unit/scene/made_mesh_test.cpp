#include "render/scene/made_mesh.h"

#include <set>

#include "render/scene/load_scene.h"
#include "render/scene/scene_builder.h"
#include "render/scene/smooth_normals.h"
#include "tests/fakes/expect_fault.h"
#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

/// One part of the kind, with the least that it needs.
Json part_of(const MadeMeshKind& kind) {
    Json part = {{"kind", std::string(kind.name)}};
    if (kind.point_width == 2) part["points"] = {{0.0, 0.0}, {0.2, 0.0}, {0.3, 0.4}, {0.1, 0.5}};
    if (kind.point_width == 3) part["points"] = {{0, 0, 0}, {20, 45, 90}};
    if (kind.point_width == 4) part["points"] = {{0, 0, 0, 0.1}, {0, 0.5, 0, 0.2}, {0.3, 0.9, 0.1, 0.1}};
    if (kind.has_parts) {
        part["parts"] = {{{"sphere", {{"radius", 0.3}}}},
                         {{"box", {{"half_size", {0.1, 0.4, 0.1}}}}, {"operation", "subtract"}}};
    }
    return part;
}

class MadeMeshes : public GltfTest {
  protected:
    Scene load(const Json& object) {
        const Json json = {{"format", "foveray-scene"}, {"version", 1}, {"objects", {object}}};
        return load_scene(folder_.write("scene.json", json.dump()));
    }
    Scene load_part(const Json& part) { return load({{"mesh", {part}}}); }
    void expect_bad(const Json& object, const std::string& text) {
        fakes::expect_fault([&] { load(object); }, ExitCode::BadInput, text);
    }
    void expect_bad_part(const Json& part, const std::string& text) { expect_bad({{"mesh", {part}}}, text); }
};

/// Six times the volume inside, by the divergence theorem; above 0 where triangles face outwards.
double volume_of(const Primitive& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.indices.size(); i += 3) {
        const dvec3 a(p.positions[p.indices[i]]), b(p.positions[p.indices[i + 1]]),
            c(p.positions[p.indices[i + 2]]);
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum / 6.0;
}

TEST_F(MadeMeshes, areSoundForEveryKind) {
    for (const MadeMeshKind& kind : made_mesh_kinds()) {
        SCOPED_TRACE(kind.name);
        const Scene scene = load_part(part_of(kind)), again = load_part(part_of(kind));
        const Primitive& p = scene.meshes.at(0).primitives.at(0);
        EXPECT_EQ(p.positions, again.meshes[0].primitives[0].positions);
        EXPECT_EQ(p.indices, again.meshes[0].primitives[0].indices);
        ASSERT_EQ(p.normals.size(), p.positions.size());
        for (const vec3 n : p.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f);
        std::size_t turned = 0;
        for (std::size_t i = 0; i < p.indices.size(); i += 3) {
            const vec3 a = p.positions[p.indices[i]], b = p.positions[p.indices[i + 1]],
                       c = p.positions[p.indices[i + 2]];
            const vec3 cross = glm::cross(b - a, c - a);
            ASSERT_GT(glm::length(cross), 0.0f);
            turned += glm::dot(cross, p.normals[p.indices[i]] + p.normals[p.indices[i + 1]] +
                                          p.normals[p.indices[i + 2]]) < 0.0f;
        }
        EXPECT_LE(turned, p.indices.size() / 3 / 200);  // slivers of marched surfaces
    }
}

TEST_F(MadeMeshes, encloseTheirVolume) {
    const auto volume = [&](const Json& part) { return volume_of(load_part(part).meshes[0].primitives[0]); };
    EXPECT_NEAR(volume({{"kind", "lathe"},
                        {"parameters", {{"segments", 256}}},
                        {"points", {{0, 0}, {0.5, 0}, {0.5, 0}, {0.5, 2}, {0.5, 2}, {0, 2}}}}),
                pi * 0.25 * 2.0, 2e-3);
    EXPECT_NEAR(volume({{"kind", "tube"},
                        {"parameters", {{"segments", 256}}},
                        {"points", {{0, 0, 0, 0.5}, {0, 2, 0, 0.5}}}}),
                pi * 0.25 * 2.0, 2e-3);
    EXPECT_NEAR(
        volume({{"kind", "torus_knot"},
                {"parameters",
                 {{"turns", 1}, {"windings", 0}, {"radius", 1}, {"tube_radius", 0.25}, {"segments", 128}}}}),
        2.0 * pi * pi * 0.0625, 3e-3);
    EXPECT_NEAR(volume({{"kind", "box"}, {"parameters", {{"half_size", {1, 2, 3}}, {"bevel", 0}}}}), 48.0,
                1e-3);
    EXPECT_NEAR(volume({{"kind", "boulder"},
                        {"parameters", {{"radius", 1}, {"relief", 0}, {"facets", 0}, {"subdivisions", 48}}}}),
                4.0 / 3.0 * pi, 1e-2);
    EXPECT_NEAR(volume({{"kind", "blend"},
                        {"parameters", {{"resolution", 96}}},
                        {"parts", {{{"sphere", {{"radius", 1}}}}}}}),
                4.0 / 3.0 * pi, 1e-2);
}

TEST_F(MadeMeshes, partsWithOneMaterialAreOnePrimitive) {
    const Json red = {{"base_color", {1, 0, 0}}}, blue = {{"base_color", {0, 0, 1}}};
    const auto box = [](const Json& material, const Json& transform) {
        return Json{{"kind", "box"}, {"material", material}, {"transform", transform}};
    };
    const Scene scene = load({{"name", "three"},
                              {"mesh",
                               {box(red, {{"translation", {2, 0, 0}}}), box(red, {{"scale", {1, 3, 1}}}),
                                box(blue, {{"translation", {0, 0, -4}}})}}});
    ASSERT_EQ(scene.instances.size(), 1u);
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.name, "three");
    ASSERT_EQ(mesh.primitives.size(), 2u);
    EXPECT_EQ(scene.materials[mesh.primitives[1].material].base_color, vec4(0, 0, 1, 1));
    expect_near(mesh.bounds.min, {-0.5f, -1.5f, -4.5f});
    expect_near(mesh.bounds.max, {2.5f, 1.5f, 0.5f});
}

TEST_F(MadeMeshes, normalsAreSmoothUpToTheCrease) {
    const auto normals = [&](float crease) {
        Primitive box = make_box(vec3(1.0f)).primitives[0];
        box.normals.clear();
        make_smooth_normals(box, radians(crease));
        return box.normals;
    };
    EXPECT_EQ(normals(89.0f).size(), 24u);
    for (const vec3 n : normals(91.0f)) expect_near(glm::abs(n), vec3(std::sqrt(1.0f / 3.0f)), 1e-4f);
}

TEST_F(MadeMeshes, veinsColorTheVertices) {
    const Scene scene = load_part(
        {{"kind", "boulder"},
         {"parameters", {{"vein_size", 0.3}, {"ground_color", {0, 0, 1}}, {"vein_color", {1, 0, 0}}}}});
    float least = 1.0f, most = 0.0f;
    for (const vec4& c : scene.meshes[0].primitives[0].colors) {
        EXPECT_NEAR(c.r + c.b, 1.0f, 1e-5f);
        least = std::min(least, c.r), most = std::max(most, c.r);
    }
    EXPECT_LT(least, 0.1f);
    EXPECT_GT(most, 0.7f);
}

TEST_F(MadeMeshes, acuityPatchesHaveTheirFrequencies) {
    const Scene scene = load_part({{"kind", "acuity_patches"},
                                   {"pattern", "sine"},
                                   {"parameters", {{"distance", 3}, {"frequency", 0.5}}},
                                   {"points", {{0, 0, 0}, {19, 30, 0}, {39, 200, 90}}}});
    const Primitive& p = scene.meshes.at(0).primitives.at(0);
    ASSERT_EQ(p.positions.size(), 12u);
    EXPECT_TRUE(scene.materials[p.material].base_color_texture);
    const float ppd[] = {60.0f, 10.0f, 5.0f}, eccentricity[] = {0.0f, 19.0f, 39.0f};
    for (std::size_t patch = 0; patch < 3; ++patch) {
        const vec3* corner = &p.positions[4 * patch];
        const vec3 middle = 0.5f * (corner[0] + corner[2]);
        EXPECT_NEAR(glm::length(middle), 3.0f, 1e-4f);
        EXPECT_NEAR(degrees(std::acos(-middle.z / 3.0f)), eccentricity[patch], 0.02f);
        const float cycles = p.uv0[4 * patch + 1].x - p.uv0[4 * patch].x;
        const float width = 2.0f * degrees(std::atan(0.5f * glm::distance(corner[0], corner[1]) / 3.0f));
        EXPECT_NEAR(cycles / width, 0.5f * ppd[patch], 0.001f * ppd[patch]);
        EXPECT_GT(glm::dot(p.normals[4 * patch], -middle), 2.9f) << "faces the seat";
    }
    // The third is turned: its stripes run along the radius.
    const vec3 across = p.positions[9] - p.positions[8], middle = 0.5f * (p.positions[8] + p.positions[10]);
    EXPECT_NEAR(glm::dot(across, vec3(0, 0, 1)), 0.0f, 1e-4f);
    EXPECT_NEAR(glm::dot(across, middle), 0.0f, 1e-4f);
}

TEST_F(MadeMeshes, badOnesAreNamed) {
    expect_bad(Json::object(), "give one of them");
    expect_bad({{"shape", "sphere"}, {"mesh", {{{"kind", "box"}}}}}, "give one of them");
    expect_bad({{"mesh", {{{"kind", "box"}}}}, {"material", Json::object()}}, "/objects/0/material");
    expect_bad_part({{"kind", "torus_not"}}, "did you mean \"torus_knot\"");
    expect_bad_part({{"kind", "box"}, {"parameters", {{"bevil", 1}}}}, "did you mean \"bevel\"");
    expect_bad_part({{"kind", "box"}, {"parameters", {{"bevel", -1}}}}, "out of range");
    expect_bad_part({{"kind", "box"}, {"points", {{0, 0}, {1, 1}}}}, "/objects/0/mesh/0/points");
    expect_bad_part({{"kind", "lathe"}}, "has no \"points\"");
    expect_bad_part({{"kind", "lathe"}, {"points", {{0, 0, 0}, {1, 1, 0}}}}, "has 3 numbers");
    expect_bad_part({{"kind", "lathe"}, {"points", {{0, 0}, {-1, 1}}}}, "radius below 0");
    expect_bad_part({{"kind", "lathe"}, {"points", {{1, 1}, {1, 1}}}}, "are all the same");
    expect_bad_part({{"kind", "blend"}}, "has no \"parts\"");
    expect_bad_part({{"kind", "lathe"}, {"points", {{0, 0}, {0, 1}}}}, "makes no triangles");
}

TEST_F(MadeMeshes, lightsMayMove) {
    const Json json = {{"format", "foveray-scene"},
                       {"version", 1},
                       {"lights",
                        {{{"type", "area"},
                          {"center", {1, 2, 0}},
                          {"half_u", {0, 0, 0.5}},
                          {"half_v", {-0.25, 0, 0}},
                          {"animation",
                           {{{"property", "translation"}, {"times", {0}}, {"values", {{0, 0, -3}}}},
                            {{"property", "rotation"},
                             {"times", {0, 1, 2}},
                             {"values", {{0, 0, 0, 1}, {0, 1, 0, 1}, {0, 1, 0, 0}}}}}}}}}};
    const Scene scene = load_scene(folder_.write("scene.json", json.dump()));
    SceneAnimator animator(scene);
    expect_near(animator.advance(0).area_lights.at(0).center, {1, 2, -3});
    for (const float seconds : {0.5f, 1.0f, 1.7f}) {
        const PlacedAreaLight light =
            animator.advance(static_cast<Nanoseconds>(seconds * 1e9f)).area_lights.at(0);
        const float angle = 0.5f * pi * seconds;
        expect_near(light.center, {std::cos(angle), 2, -3 - std::sin(angle)}, 1e-4f);
        expect_near(glm::normalize(glm::cross(light.half_u, light.half_v)), {0, -1, 0}, 1e-4f);
    }
}

}  // namespace
}  // namespace foveray::scene
