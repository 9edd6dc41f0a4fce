#include "render/mesh_store.h"

#include <cstring>
#include <utility>

namespace foveray::render {
namespace {

/// Fowler, Noll and Vo's sum, eight bytes at a time, the high half mixed back in.
class Sum {
  public:
    explicit Sum(std::uint64_t prime) : prime_(prime) {}

    void add(std::span<const std::byte> bytes) {
        add_word(bytes.size());
        for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data(), 8);
            add_word(word);
        }
        std::uint64_t rest = 0;
        std::memcpy(&rest, bytes.data(), bytes.size());
        add_word(rest);
    }
    std::uint64_t value() const { return value_; }

  private:
    void add_word(std::uint64_t word) {
        value_ = (value_ ^ word) * prime_;
        value_ ^= value_ >> 32;
    }

    std::uint64_t prime_;
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::vector<scene::MeshLevel> levels_of(const scene::Mesh& mesh, bool rigid) {
    if (!rigid) return {};
    return scene::make_mesh_levels(mesh);
}

}  // namespace

SharedMesh::SharedMesh(gpu::Uploader& uploader, const std::string& name, const scene::Mesh& mesh, bool rigid)
    : SharedMesh(uploader, name, mesh, levels_of(mesh, rigid)) {}

SharedMesh::SharedMesh(gpu::Uploader& uploader, const std::string& name, const scene::Mesh& mesh,
                       const std::vector<scene::MeshLevel>& levels)
    : mesh_(uploader, name, mesh, levels) {
    if (levels.empty()) return;
    level_errors_ = {0.0f};
    for (const scene::MeshLevel& level : levels) level_errors_.push_back(level.error);
}

std::shared_ptr<gpu::BottomLevel> SharedMesh::built(std::uint32_t level,
                                                    const std::vector<bool>& opaque) const {
    const auto found = built_.find({level, opaque});
    return found != built_.end() ? found->second : nullptr;
}

void SharedMesh::keep(std::uint32_t level, std::vector<bool> opaque,
                      std::shared_ptr<gpu::BottomLevel> structure) {
    built_[{level, std::move(opaque)}] = std::move(structure);
}

MeshStore::Key MeshStore::key_of(const scene::Mesh& mesh, bool rigid) {
    Sum first(0x100000001b3u), second(0x9e3779b97f4a7c15u);
    const auto add = [&](const auto& values) {
        first.add(gpu::range_bytes(values));
        second.add(gpu::range_bytes(values));
    };
    for (const scene::Primitive& p : mesh.primitives) {
        add(p.positions);
        add(p.normals);
        add(p.tangents);
        add(p.uv0);
        add(p.uv1);
        add(p.colors);
        add(p.indices);
    }
    return {{first.value(), second.value()}, rigid};
}

std::shared_ptr<SharedMesh> MeshStore::get(gpu::Uploader& uploader, const std::string& name,
                                           const scene::Mesh& mesh, bool rigid) {
    std::erase_if(meshes_, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<SharedMesh>& known = meshes_[key_of(mesh, rigid)];
    if (auto mesh_there = known.lock()) return mesh_there;
    auto made = std::make_shared<SharedMesh>(uploader, name, mesh, rigid);
    known = made;
    return made;
}

}  // namespace foveray::render
