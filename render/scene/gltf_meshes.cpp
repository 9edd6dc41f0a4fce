#include "render/scene/gltf_meshes.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace foveray::scene {
namespace {

vec3 unit_or_up(vec3 v) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : vec3(0, 1, 0);
}

/// The corners of triangles that a strip or fan makes (glTF 2.0 section 3.7.2.1).
std::vector<std::uint32_t> triangle_corners(const std::vector<std::uint32_t>& v, int mode) {
    std::vector<std::uint32_t> out;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        out.assign(v.begin(), v.end() - static_cast<std::ptrdiff_t>(v.size() % 3));
        return out;
    }
    for (std::size_t i = 0; i + 2 < v.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            const std::size_t odd = i % 2;
            out.insert(out.end(), {v[i], v[i + 1 + odd], v[i + 2 - odd]});
        } else {
            out.insert(out.end(), {v[i + 1], v[i + 2], v[0]});
        }
    }
    return out;
}

class MeshReader {
  public:
    MeshReader(SceneBuilder& builder, const GltfDocument& document, const std::vector<MaterialId>& materials)
        : builder_(builder), document_(document), materials_(materials) {}

    std::optional<MeshId> add(std::size_t index);
    void report_skipped();

  private:
    /// Nothing if it makes no triangles.
    std::optional<Primitive> read(const tinygltf::Primitive& parsed, const std::string& place);
    void read_attributes(Primitive& p, const tinygltf::Primitive& parsed, const std::string& place);
    void read_skinning(Primitive& p, const tinygltf::Primitive& parsed, const std::string& place);
    void read_targets(Primitive& p, const tinygltf::Primitive& parsed, const std::string& place);
    void check_count(std::size_t count, std::size_t expected, const std::string& place) const {
        if (count == expected || count == 0) return;
        document_.fault(place, "has " + std::to_string(count) + " elements where the primitive has " +
                                   std::to_string(expected) + " vertices");
    }

    SceneBuilder& builder_;
    const GltfDocument& document_;
    const std::vector<MaterialId>& materials_;
    int points_and_lines_ = 0, without_triangles_ = 0, with_more_joints_ = 0;
};

std::optional<MeshId> MeshReader::add(std::size_t index) {
    const tinygltf::Mesh& parsed = document_.model.meshes[index];
    const std::string place = "/meshes/" + std::to_string(index);
    Mesh mesh;
    mesh.name = parsed.name;
    std::optional<std::size_t> targets;
    for (std::size_t i = 0; i < parsed.primitives.size(); ++i) {
        const std::string here = place + "/primitives/" + std::to_string(i);
        const std::size_t count = parsed.primitives[i].targets.size();
        if (targets.value_or(count) != count) {
            document_.fault(here + "/targets", "must be as many as in the mesh's other primitives");
        }
        targets = count;
        if (auto primitive = read(parsed.primitives[i], here))
            mesh.primitives.push_back(std::move(*primitive));
    }
    for (const double weight : parsed.weights) mesh.morph_weights.push_back(static_cast<float>(weight));
    if (mesh.primitives.empty()) return std::nullopt;
    return builder_.add(std::move(mesh));
}

std::optional<Primitive> MeshReader::read(const tinygltf::Primitive& parsed, const std::string& place) {
    if (parsed.mode >= TINYGLTF_MODE_POINTS && parsed.mode < TINYGLTF_MODE_TRIANGLES) {
        ++points_and_lines_;
        return std::nullopt;
    }
    if (parsed.mode < TINYGLTF_MODE_POINTS || parsed.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        document_.fault(place + "/mode", "must be 0 to 6");
    }
    const auto positions = parsed.attributes.find("POSITION");
    if (positions == parsed.attributes.end()) {
        ++without_triangles_;
        return std::nullopt;
    }
    Primitive p;
    p.positions = read_vec3(document_, positions->second, place + "/attributes/POSITION");

    std::vector<std::uint32_t> vertices;
    if (parsed.indices >= 0) {
        vertices = read_integers(document_, parsed.indices, 1, place + "/indices");
        const auto past =
            std::ranges::find_if(vertices, [&](std::uint32_t v) { return v >= p.positions.size(); });
        if (past != vertices.end()) {
            document_.fault(place + "/indices", "element " + std::to_string(past - vertices.begin()) +
                                                    " is " + std::to_string(*past) + ", but there are " +
                                                    std::to_string(p.positions.size()) + " vertices");
        }
    } else {
        vertices.resize(p.positions.size());
        std::iota(vertices.begin(), vertices.end(), 0u);
    }
    p.indices = triangle_corners(vertices, parsed.mode);
    if (p.indices.empty()) {
        ++without_triangles_;
        return std::nullopt;
    }
    p.material = parsed.material < 0 ? 0 : materials_[static_cast<std::size_t>(parsed.material)];
    read_attributes(p, parsed, place);
    read_skinning(p, parsed, place);
    read_targets(p, parsed, place);
    return p;
}

void MeshReader::read_attributes(Primitive& p, const tinygltf::Primitive& parsed, const std::string& place) {
    for (const auto& [name, accessor] : parsed.attributes) {
        const std::string here = place + "/attributes/" + name;
        if (name == "NORMAL") {
            p.normals = read_vec3(document_, accessor, here);
            check_count(p.normals.size(), p.positions.size(), here);
            for (vec3& n : p.normals) n = unit_or_up(n);
        } else if (name == "TANGENT" && parsed.attributes.contains("NORMAL")) {
            p.tangents = read_vec4(document_, accessor, here);
            check_count(p.tangents.size(), p.positions.size(), here);
            for (vec4& t : p.tangents) t = vec4(unit_or_up(vec3(t)), t.w < 0.0f ? -1.0f : 1.0f);
        } else if (name == "TEXCOORD_0" || name == "TEXCOORD_1") {
            std::vector<vec2>& uv = name == "TEXCOORD_0" ? p.uv0 : p.uv1;
            uv = read_vec2(document_, accessor, here);
            check_count(uv.size(), p.positions.size(), here);
        } else if (name == "COLOR_0") {
            if (component_count(document_, accessor) == 3) {
                for (const vec3 rgb : read_vec3(document_, accessor, here)) p.colors.emplace_back(rgb, 1.0f);
            } else {
                p.colors = read_vec4(document_, accessor, here);
            }
            check_count(p.colors.size(), p.positions.size(), here);
        }
    }
}

void MeshReader::read_skinning(Primitive& p, const tinygltf::Primitive& parsed, const std::string& place) {
    const auto joints = parsed.attributes.find("JOINTS_0"), weights = parsed.attributes.find("WEIGHTS_0");
    if (parsed.attributes.contains("JOINTS_1")) ++with_more_joints_;
    if (joints == parsed.attributes.end() || weights == parsed.attributes.end()) return;
    const std::string here = place + "/attributes/JOINTS_0";
    const auto indices = read_integers(document_, joints->second, 4, here);
    p.weights = read_vec4(document_, weights->second, place + "/attributes/WEIGHTS_0");
    check_count(indices.size() / 4, p.positions.size(), here);
    check_count(p.weights.size(), p.positions.size(), place + "/attributes/WEIGHTS_0");
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
        glm::u16vec4 joint;
        for (int k = 0; k < 4; ++k) {
            const std::uint32_t value = indices[4 * i + static_cast<std::size_t>(k)];
            if (value > std::numeric_limits<std::uint16_t>::max())
                document_.fault(here, "names a joint past 65535");
            joint[k] = static_cast<std::uint16_t>(p.weights[i][k] == 0.0f ? 0 : value);
        }
        p.joints.push_back(joint);
        const vec4 w = p.weights[i];
        const float sum = w.x + w.y + w.z + w.w;
        p.weights[i] = sum > 0.0f ? w / sum : vec4(1, 0, 0, 0);
    }
}

void MeshReader::read_targets(Primitive& p, const tinygltf::Primitive& parsed, const std::string& place) {
    for (std::size_t i = 0; i < parsed.targets.size(); ++i) {
        MorphTarget target;
        for (const auto& [name, accessor] : parsed.targets[i]) {
            std::vector<vec3>* values = name == "POSITION"  ? &target.positions
                                        : name == "NORMAL"  ? &target.normals
                                        : name == "TANGENT" ? &target.tangents
                                                            : nullptr;
            if (!values) continue;
            const std::string here = place + "/targets/" + std::to_string(i) + "/" + name;
            *values = read_vec3(document_, accessor, here);
            check_count(values->size(), p.positions.size(), here);
        }
        p.morph_targets.push_back(std::move(target));
    }
}

void MeshReader::report_skipped() {
    const auto warn = [&](int count, const std::string& what) {
        if (count > 0) builder_.warn(document_.file.string() + ": " + std::to_string(count) + " " + what);
    };
    warn(points_and_lines_, "primitive(s) of points or lines are skipped");
    warn(without_triangles_, "primitive(s) without positions or triangles are skipped");
    warn(with_more_joints_, "primitive(s) have more than four joints a vertex; the first four are used");
}

}  // namespace

std::vector<std::optional<MeshId>> add_meshes(SceneBuilder& builder, const GltfDocument& document,
                                              const std::vector<MaterialId>& materials) {
    MeshReader reader(builder, document, materials);
    std::vector<std::optional<MeshId>> ids;
    for (std::size_t i = 0; i < document.model.meshes.size(); ++i) ids.push_back(reader.add(i));
    reader.report_skipped();
    return ids;
}

}  // namespace foveray::scene
