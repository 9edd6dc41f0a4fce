#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/gpu/acceleration.h"
#include "render/scene/mesh.h"
#include "render/scene/mesh_levels.h"
#include "shaders/shared/scene.h"

namespace foveray::render {

/// Where shaders and builds find the triangles of one primitive.
struct GpuGeometry {
    vk::DeviceAddress positions = 0;           // vec3[vertex_count]
    vk::DeviceAddress previous_positions = 0;  // of the frame before; the same unless the mesh deforms
    vk::DeviceAddress indices = 0;             // uint[3 * triangle_count]
    vk::DeviceAddress attributes = 0;          // shared::VertexAttributes[vertex_count]; 0 for real surfaces
    std::uint32_t vertex_count = 0, triangle_count = 0;
    scene::MaterialId material = 0;
};

/// A primitive's vertices as shaders read them.
std::vector<shared::VertexAttributes> pack_attributes(const scene::Primitive& primitive);

/// A mesh on the GPU: its primitives one after the other in three buffers.
class GpuMesh {
  public:
    GpuMesh(gpu::Uploader& uploader, const std::string& name, const scene::Mesh& mesh,
            std::span<const scene::MeshLevel> levels = {});

    const std::vector<GpuGeometry>& geometries() const { return geometries_; }
    /// Of the n-th of the levels given: the same vertices, other triangles.
    const std::vector<GpuGeometry>& level(std::size_t n) const { return levels_[n]; }

  private:
    gpu::Buffer positions_, indices_, attributes_;
    std::vector<GpuGeometry> geometries_;
    std::vector<std::vector<GpuGeometry>> levels_;
};

}  // namespace foveray::render
