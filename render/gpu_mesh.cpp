#include "render/gpu_mesh.h"

#include <glm/gtc/packing.hpp>

namespace foveray::render {

std::vector<shared::VertexAttributes> pack_attributes(const scene::Primitive& primitive) {
    std::vector<shared::VertexAttributes> result(primitive.positions.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        shared::VertexAttributes& v = result[i];
        v.normal = primitive.normals[i];
        v.tangent = primitive.tangents.empty() ? vec4(0.0f, 0.0f, 0.0f, 1.0f) : primitive.tangents[i];
        v.uv0 = primitive.uv0.empty() ? vec2(0.0f) : primitive.uv0[i];
        v.uv1 = primitive.uv1.empty() ? vec2(0.0f) : primitive.uv1[i];
        const vec4 color = primitive.colors.empty() ? vec4(1.0f) : primitive.colors[i];
        v.color = {glm::packHalf2x16({color.r, color.g}), glm::packHalf2x16({color.b, color.a})};
    }
    return result;
}

GpuMesh::GpuMesh(gpu::Uploader& uploader, const std::string& name, const scene::Mesh& mesh,
                 std::span<const scene::MeshLevel> levels) {
    std::vector<vec3> positions;
    std::vector<std::uint32_t> indices;
    std::vector<shared::VertexAttributes> attributes;
    for (const scene::Primitive& p : mesh.primitives) {
        GpuGeometry geometry;  // offsets at first, addresses when the buffers exist
        geometry.positions = positions.size() * sizeof(vec3);
        geometry.indices = indices.size() * sizeof(std::uint32_t);
        geometry.attributes = attributes.size() * sizeof(shared::VertexAttributes);
        geometry.vertex_count = static_cast<std::uint32_t>(p.positions.size());
        geometry.triangle_count = static_cast<std::uint32_t>(p.indices.size() / 3);
        geometry.material = p.material;
        geometries_.push_back(geometry);
        positions.insert(positions.end(), p.positions.begin(), p.positions.end());
        indices.insert(indices.end(), p.indices.begin(), p.indices.end());
        const auto packed = pack_attributes(p);
        attributes.insert(attributes.end(), packed.begin(), packed.end());
    }
    for (const scene::MeshLevel& level : levels) {
        levels_.push_back(geometries_);
        for (std::size_t i = 0; i < level.indices.size(); ++i) {
            if (level.indices[i].size() == mesh.primitives[i].indices.size()) continue;  // shares level 0's
            levels_.back()[i].indices = indices.size() * sizeof(std::uint32_t);
            levels_.back()[i].triangle_count = static_cast<std::uint32_t>(level.indices[i].size() / 3);
            indices.insert(indices.end(), level.indices[i].begin(), level.indices[i].end());
        }
    }
    positions_ = uploader.buffer(name + " positions", gpu::range_bytes(positions), gpu::build_input);
    indices_ = uploader.buffer(name + " indices", gpu::range_bytes(indices), gpu::build_input);
    attributes_ = uploader.buffer(name + " attributes", gpu::range_bytes(attributes));
    const auto place = [&](std::vector<GpuGeometry>& geometries) {
        for (GpuGeometry& geometry : geometries) {
            geometry.positions += positions_.address();
            geometry.previous_positions = geometry.positions;
            geometry.indices += indices_.address();
            geometry.attributes += attributes_.address();
        }
    };
    place(geometries_);
    for (std::vector<GpuGeometry>& level : levels_) place(level);
}

}  // namespace foveray::render
