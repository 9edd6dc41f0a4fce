#include "render/scene/vox_file.h"

#include <algorithm>

#include "base/error.h"
#include "render/scene/vox_chunks.h"
#include "shaders/shared/voxels.h"

namespace foveray::scene {
namespace {

struct PlacedVoxel {
    glm::ivec3 cell;  // y up
    std::uint8_t color = 0;
};

/// The voxels of all models, where the scene graph puts them.
class Placer {
  public:
    Placer(const VoxFile& vox, std::string file) : vox_(vox), file_(std::move(file)) {}

    std::vector<PlacedVoxel> place() {
        if (vox_.nodes.empty()) {
            const glm::ivec3 half = vox_.models[0].size / 2;
            add(vox_.models[0], glm::imat3x3(1), {0, 0, half.z});
        } else {
            visit(0, glm::imat3x3(1), glm::ivec3(0), 0);
        }
        return std::move(placed_);
    }

  private:
    static constexpr int deepest = 64;
    static constexpr int most_visits = 1 << 16;

    [[noreturn]] void too_large() const {
        throw_bad_input(file_, "its scene graph is too large, or goes in circles", "take a smaller one");
    }

    void visit(std::int32_t id, const glm::imat3x3& rotation, glm::ivec3 translation, int level) {
        if (level > deepest || ++visits_ > most_visits) too_large();
        const VoxFile::Node& node = vox_.nodes.at(id);
        if (node.hidden) return;
        for (const std::int32_t child : node.children) {
            if (node.kind == VoxFile::Node::Kind::Shape) {
                add(vox_.models[static_cast<std::size_t>(child)], rotation, translation);
            } else {
                visit(child, rotation * node.rotation, translation + rotation * node.translation, level + 1);
            }
        }
    }

    void add(const VoxFile::Model& model, const glm::imat3x3& rotation, glm::ivec3 translation) {
        if (placed_.size() + model.voxels.size() > shared::VOXEL_MAX_NODES) too_large();
        for (const VoxFile::Voxel& v : model.voxels) {
            // Twice the middle of the voxel from the model's middle, so that it is a whole number.
            const glm::ivec3 twice = 2 * (glm::ivec3(v.x, v.y, v.z) - model.size / 2) + 1;
            const glm::ivec3 turned = (rotation * twice - 1) / 2 + translation;
            placed_.push_back({{turned.x, turned.z, -turned.y - 1}, v.color});
        }
    }

    const VoxFile& vox_;
    std::string file_;
    std::vector<PlacedVoxel> placed_;
    int visits_ = 0;
};

/// What can be seen, with the mean of the open sides' directions for a normal.
std::vector<VoxelSample> visible(const std::vector<PlacedVoxel>& placed, glm::ivec3 low,
                                 const std::array<vec3, 256>& palette) {
    std::vector<std::uint32_t> taken;
    for (const PlacedVoxel& v : placed) taken.push_back(morton_of(glm::uvec3(v.cell - low)));
    std::ranges::sort(taken);
    const auto is_open = [&](glm::ivec3 place) {
        const bool inside = glm::all(glm::greaterThanEqual(place, glm::ivec3(0))) &&
                            glm::all(glm::lessThan(place, glm::ivec3(largest_voxel_grid)));
        return !inside || !std::ranges::binary_search(taken, morton_of(glm::uvec3(place)));
    };
    std::vector<VoxelSample> samples;
    for (const PlacedVoxel& v : placed) {
        const glm::ivec3 place = v.cell - low;
        vec3 normal(0.0f);
        bool open = false;
        for (int axis = 0; axis < 3; ++axis) {
            for (const int side : {-1, 1}) {
                glm::ivec3 step(0);
                step[axis] = side;
                if (!is_open(place + step)) continue;
                open = true;
                normal += vec3(step);
            }
        }
        if (!open) continue;
        samples.push_back({morton_of(glm::uvec3(place)), 1.0f, palette[v.color], normal});
    }
    return samples;
}

}  // namespace

Voxels read_vox(const std::filesystem::path& file, float voxel_size) {
    const VoxFile vox = read_vox_chunks(file);
    const std::vector<PlacedVoxel> placed = Placer(vox, file.string()).place();
    if (placed.empty()) throw_bad_input(file.string(), "no voxel of it is shown", "take another file");
    glm::ivec3 low = placed[0].cell, high = low;
    for (const PlacedVoxel& v : placed) low = glm::min(low, v.cell), high = glm::max(high, v.cell);
    if (glm::any(glm::greaterThanEqual(high - low, glm::ivec3(largest_voxel_grid)))) {
        throw_bad_input(file.string(), "its models are spread over more than 1024 voxels",
                        "move them closer together");
    }
    Voxels voxels;
    voxels.origin = voxel_size * vec3(low);
    voxels.voxel_size = voxel_size;
    voxels.show_faces = true;
    if (!build_tree(visible(placed, low, vox.palette), voxels)) {
        throw_bad_input(file.string(), "it has too many voxels", "take a smaller one");
    }
    return voxels;
}

}  // namespace foveray::scene
