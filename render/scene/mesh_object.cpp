#include "render/scene/mesh_object.h"

#include <cmath>

#include "render/scene/made_mesh.h"
#include "render/scene/scene_blend.h"
#include "render/scene/scene_material.h"
#include "render/scene/scene_parameters.h"

namespace foveray::scene {
namespace {

constexpr std::size_t most_triangles = 20'000'000;  // of one object

class PartReader {
  public:
    PartReader(const SceneValues& values, const Json& json, const std::string& place)
        : values_(values), json_(json), place_(place) {}

    MadeMesh read() const {
        MadeMesh mesh;
        mesh.kind = &kind();
        mesh.values = default_values(mesh.kind->parameters);
        read_parameters(values_, json_, place_, mesh.kind->parameters, mesh.values);
        if (wanted("points", mesh.kind->point_width > 0)) mesh.points = points(mesh.kind->point_width);
        if (wanted("parts", mesh.kind->has_parts)) {
            mesh.parts = read_blend_parts(values_, json_["parts"], place_ + "/parts");
        }
        return mesh;
    }

  private:
    const MadeMeshKind& kind() const {
        const std::string name = json_["kind"];
        std::vector<std::string_view> names;
        for (const MadeMeshKind& kind : made_mesh_kinds()) {
            if (kind.name == name) return kind;
            names.push_back(kind.name);
        }
        values_.fault(place_ + "/kind", "\"" + name + "\" is no kind of mesh", did_you_mean(name, names));
    }

    bool wanted(const char* key, bool needed) const {
        if (json_.contains(key) == needed) return needed;
        needed ? values_.fault(place_, std::string("has no \"") + key + "\"",
                               "give some: docs/scene-format.md shows how")
               : values_.fault(place_ + "/" + key, "this kind of mesh has none", "leave them out");
    }

    std::vector<vec4> points(std::uint32_t width) const {
        std::vector<vec4> result;
        const Json& list = json_["points"];
        bool distinct = false;
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::string at = place_ + "/points/" + std::to_string(i);
            if (list[i].size() != width) {
                values_.fault(at, "has " + std::to_string(list[i].size()) + " numbers",
                              "give " + std::to_string(width));
            }
            vec4 p(0.0f);
            for (std::uint32_t k = 0; k < width; ++k) p[static_cast<int>(k)] = list[i][k].get<float>();
            if (!(glm::length(p) < 1e4f)) values_.fault(at, "is too far away", "correct it");
            const float radius = width == 2 ? p.x : width == 4 ? p.w : 0.0f;
            if (radius < 0.0f) values_.fault(at, "has a radius below 0", "correct it");
            result.push_back(p);
            distinct |= p != result.front();
        }
        if (!distinct && width != 3)
            values_.fault(place_ + "/points", "are all the same", "give two different ones");
        return result;
    }

    const SceneValues& values_;
    const Json& json_;
    const std::string& place_;
};

/// A texture that goes from black to white and back as a sine of u, once in 0..1; in linear light, whatever
/// its level of detail: a power of two of texels a period has levels that are its means.
TextureId add_grating(SceneBuilder& builder) {
    constexpr std::uint32_t texels = 64;
    constexpr const char* name = "sine grating";
    for (TextureId id = 0; id < builder.so_far().textures.size(); ++id) {
        if (builder.so_far().images[builder.so_far().textures[id].image].name == name) return id;
    }
    TextureImage image{.name = name, .pixels = Image(texels, texels, 4)};
    for (std::uint32_t y = 0; y < texels; ++y) {
        for (std::uint32_t x = 0; x < texels; ++x) {
            const float phase = 2.0f * pi * (static_cast<float>(x) + 0.5f) / static_cast<float>(texels);
            const float shade = 255.0f * srgb_from_linear(0.5f + 0.5f * std::sin(phase)) + 0.5f;
            std::uint8_t* const texel = &image.pixels.pixels[4 * (y * texels + x)];
            texel[0] = texel[1] = texel[2] = static_cast<std::uint8_t>(shade);
            texel[3] = 255;
        }
    }
    return builder.add(Texture{builder.add(std::move(image)), Sampler{}});
}

void append(Primitive& to, const Primitive& from, const mat4& to_from_part) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    const mat3 normal_matrix = glm::transpose(glm::inverse(mat3(to_from_part)));
    for (const vec3 p : from.positions) to.positions.push_back(vec3(to_from_part * vec4(p, 1.0f)));
    for (const vec3 n : from.normals) to.normals.push_back(glm::normalize(normal_matrix * n));
    // Primitives that are joined may have what others lack.
    if (!from.uv0.empty() || !to.uv0.empty()) {
        to.uv0.resize(first, vec2(0.0f));
        to.uv0.insert(to.uv0.end(), from.uv0.begin(), from.uv0.end());
        to.uv0.resize(to.positions.size(), vec2(0.0f));
    }
    if (!from.colors.empty() || !to.colors.empty()) {
        to.colors.resize(first, vec4(1.0f));
        to.colors.insert(to.colors.end(), from.colors.begin(), from.colors.end());
        to.colors.resize(to.positions.size(), vec4(1.0f));
    }
    for (const std::uint32_t i : from.indices) to.indices.push_back(first + i);
}

}  // namespace

Mesh read_mesh_parts(SceneBuilder& builder, const SceneValues& values, const Json& parts,
                     const std::string& name, const std::string& place) {
    Mesh mesh;
    mesh.name = name;
    Json material_of_last;
    bool grating_in_last = false;
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string at = place + "/" + std::to_string(i);
        const Primitive made = make_mesh(PartReader(values, parts[i], at).read());
        if (made.indices.empty()) values.fault(at, "makes no triangles", "correct its parameters");
        const Json material = parts[i].value("material", Json::object());
        const bool grating = parts[i].contains("pattern");
        if (i == 0 || material != material_of_last || grating != grating_in_last) {
            Material read = read_material(values, material, name + "/" + parts[i]["kind"].get<std::string>(),
                                          at + "/material");
            if (grating) read.base_color_texture.texture = add_grating(builder);
            mesh.primitives.emplace_back().material =
                add_material(builder, values, material, std::move(read), at + "/material");
            material_of_last = material, grating_in_last = grating;
        }
        const Json places = parts[i].value("instances", Json::array({Json::object()}));
        const mat4 object_from_part =
            parts[i].contains("transform")
                ? to_matrix(values.transform(parts[i]["transform"], at + "/transform"))
                : mat4(1.0f);
        triangles += places.size() * made.indices.size() / 3;
        if (triangles > most_triangles) values.fault(at, "makes too many triangles", "make it coarser");
        for (std::size_t k = 0; k < places.size(); ++k) {
            const Transform instance = values.transform(places[k], at + "/instances/" + std::to_string(k));
            append(mesh.primitives.back(), made, to_matrix(instance) * object_from_part);
        }
    }
    return mesh;
}

}  // namespace foveray::scene
