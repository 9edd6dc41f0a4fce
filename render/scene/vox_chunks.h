#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/math.h"

namespace foveray::scene {

/// What a MagicaVoxel file says, in its own terms: z up.
/// https://github.com/ephtracy/voxel-model, MagicaVoxel-file-format-vox.txt and -vox-extension.txt.
struct VoxFile {
    struct Voxel {
        std::uint8_t x, y, z, color;  // 1 to 255
    };
    struct Model {
        glm::ivec3 size{0};  // 1 to 256 each
        std::vector<Voxel> voxels;
    };
    struct Node {
        enum class Kind : std::uint8_t { Transform, Group, Shape } kind = Kind::Group;
        std::vector<std::int32_t> children;  // nodes, or of a shape: models
        glm::imat3x3 rotation{1};
        glm::ivec3 translation{0};
        bool hidden = false;
    };

    std::vector<Model> models;
    std::map<std::int32_t, Node> nodes;  // by id; the root's is 0
    std::array<vec3, 256> palette{};     // linear
};

/// Reads and checks a whole file: every child that a node names is there. Throws Fault(BadInput).
VoxFile read_vox_chunks(const std::filesystem::path& file);

}  // namespace foveray::scene
