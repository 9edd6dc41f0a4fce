#include "render/scene/voxels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <span>

#include "shaders/shared/voxels.h"

namespace foveray::scene {
namespace {

std::uint32_t spread_bits(std::uint32_t v) {
    v = (v | v << 16) & 0x030000FFu;
    v = (v | v << 8) & 0x0300F00Fu;
    v = (v | v << 4) & 0x030C30C3u;
    return (v | v << 2) & 0x09249249u;
}

std::uint32_t gather_bits(std::uint32_t v) {
    v &= 0x09249249u;
    v = (v | v >> 2) & 0x030C30C3u;
    v = (v | v >> 4) & 0x0300F00Fu;
    v = (v | v >> 8) & 0x030000FFu;
    return (v | v >> 16) & 0x3FFu;
}

/// A value from 0 to 1 whose square root is kept in steps.
std::uint32_t root_steps(float value, float most) {
    return static_cast<std::uint32_t>(std::sqrt(glm::clamp(value, 0.0f, 1.0f)) * most + 0.5f);
}

std::uint32_t color_bits(vec3 color) {
    return root_steps(color.r, 255.0f) | root_steps(color.g, 255.0f) << 8 | root_steps(color.b, 255.0f) << 16;
}

glm::uvec2 octahedral(vec3 n, float most) {
    n /= std::max(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1e-12f);  // what is open all round has none
    vec2 p(n.x, n.y);
    if (n.z < 0.0f) {
        p = (1.0f - glm::abs(vec2(n.y, n.x))) * vec2(n.x >= 0.0f ? 1.0f : -1.0f, n.y >= 0.0f ? 1.0f : -1.0f);
    }
    return glm::uvec2((p * 0.5f + 0.5f) * most + 0.5f);
}

/// A voxel's part of the surface through it, as a vector. A plane with unit normal n crosses |nx| + |ny| +
/// |nz| cells for each area of a cell's side; a cube shows the sides that are open.
vec3 area_of(vec3 normal, bool cubes) {
    const vec3 n = glm::abs(normal);
    return normal / std::max(cubes ? std::max({n.x, n.y, n.z}) : n.x + n.y + n.z, 1e-12f);
}

/// Which columns of a cube, along one axis, have something in them: one bit a column, rows of 64-bit words.
class Shadow {
  public:
    explicit Shadow(std::uint32_t level)
        : side_(1u << level), words_(std::max(1u, side_ / 64)), bits_(side_ * words_) {}

    void clear() { std::ranges::fill(bits_, 0); }
    void fill() { std::ranges::fill(bits_, 1); }  // of one column
    /// Adds the shadow of a child in a quarter (u, v) of this cube.
    void add(const Shadow& child, std::uint32_t u, std::uint32_t v) {
        for (std::uint32_t row = 0; row < child.side_; ++row) {
            std::uint64_t* into = &bits_[(v * child.side_ + row) * words_];
            const std::uint64_t* from = &child.bits_[row * child.words_];
            if (child.side_ < 64) {
                *into |= *from << (u * child.side_);
            } else {
                for (std::uint32_t i = 0; i < child.words_; ++i) into[u * child.words_ + i] |= from[i];
            }
        }
    }
    float covered() const {
        std::size_t count = 0;
        for (const std::uint64_t word : bits_) count += static_cast<std::size_t>(std::popcount(word));
        return static_cast<float>(count) / (static_cast<float>(side_) * static_cast<float>(side_));
    }

  private:
    std::uint32_t side_, words_;
    std::vector<std::uint64_t> bits_;
};

using Shadows = std::array<Shadow, 3>;  // along x, y, z

class TreeBuilder {
  public:
    TreeBuilder(std::span<const VoxelSample> samples, std::uint32_t depth, bool cubes)
        : samples_(samples), cubes_(cubes), nodes_(depth + 1), links_(depth + 1) {
        for (std::uint32_t level = 0; level <= depth; ++level) {
            shadows_.push_back({Shadow(level), Shadow(level), Shadow(level)});
        }
        for (Shadow& s : shadows_[0]) s.fill();
        build(0, samples.size(), depth);
    }

    void put(Voxels& voxels) const {
        const std::size_t levels = nodes_.size();
        std::uint32_t first = 0;
        for (std::size_t level = levels; level-- > 0;) {
            voxels.level_begin.push_back(first);
            const auto next = first + static_cast<std::uint32_t>(nodes_[level].size());
            for (const std::uint32_t link : links_[level]) voxels.links.push_back(link + next);
            voxels.nodes.insert(voxels.nodes.end(), nodes_[level].begin(), nodes_[level].end());
            first = next;
        }
        voxels.level_begin.push_back(first);
    }

  private:
    static constexpr float flat_enough = 0.95f;  // length of the mean normal

    struct Sum {
        vec3 color{0.0f}, area{0.0f}, normal{0.0f};
        float voxels = 0.0f;
        float weight = 0.0f;  // of the colour
    };

    /// Makes the node of `level` over the samples [begin, end) after all below it; leaves its shadows.
    Sum build(std::size_t begin, std::size_t end, std::uint32_t level) {
        if (level == 0) {
            const VoxelSample& s = samples_[begin];
            nodes_[0].push_back(pack_voxel(s.color, s.normal));
            return {s.color, area_of(s.normal, cubes_), s.normal, 1.0f, 1.0f};
        }
        Shadows& shadows = shadows_[level];
        for (Shadow& s : shadows) s.clear();
        const auto first_child = static_cast<std::uint32_t>(nodes_[level - 1].size());
        std::uint32_t mask = 0;
        Sum sum;
        while (begin < end) {
            const std::uint32_t octant = samples_[begin].morton >> 3 * (level - 1) & 7u;
            std::size_t child_end = begin + 1;
            while (child_end < end && (samples_[child_end].morton >> 3 * (level - 1) & 7u) == octant) {
                ++child_end;
            }
            const Sum child = build(begin, child_end, level - 1);
            add_shadows(shadows, shadows_[level - 1], octant);
            mask |= 1u << octant;
            const vec3 c = coverage(shadows_[level - 1]);
            const float weight = (c.x + c.y + c.z) / 3.0f;
            sum.color += weight * child.color;
            sum.weight += weight;
            sum.area += child.area;
            sum.normal += child.normal;
            sum.voxels += child.voxels;
            begin = child_end;
        }
        sum.color /= sum.weight;
        const float side = static_cast<float>(1u << level);
        nodes_[level].push_back(pack_inner_node(sum.color, coverage(shadows), sum.area / (side * side),
                                                glm::length(sum.normal) < flat_enough * sum.voxels));
        links_[level].push_back(mask << shared::VOXEL_LINK_INDEX_BITS | first_child);
        return sum;
    }

    static void add_shadows(Shadows& into, const Shadows& child, std::uint32_t octant) {
        const std::uint32_t x = octant & 1, y = octant >> 1 & 1, z = octant >> 2;
        into[0].add(child[0], y, z);
        into[1].add(child[1], z, x);
        into[2].add(child[2], x, y);
    }

    static vec3 coverage(const Shadows& s) { return {s[0].covered(), s[1].covered(), s[2].covered()}; }

    std::span<const VoxelSample> samples_;
    bool cubes_;
    std::vector<std::vector<glm::uvec2>> nodes_;     // by level, voxels first
    std::vector<std::vector<std::uint32_t>> links_;  // by level; children counted from their level's first
    std::vector<Shadows> shadows_;                   // by level, of the node that was made last
};

std::size_t count_nodes(std::span<const VoxelSample> samples, std::uint32_t depth) {
    std::size_t count = depth + 1;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const auto differing =
            static_cast<std::uint32_t>(std::bit_width(samples[i].morton ^ samples[i - 1].morton));
        count += (differing + 2) / 3;
    }
    return count;
}

}  // namespace

std::uint32_t morton_of(glm::uvec3 p) {
    return spread_bits(p.x) | spread_bits(p.y) << 1 | spread_bits(p.z) << 2;
}

glm::uvec3 place_of(std::uint32_t morton) {
    return {gather_bits(morton), gather_bits(morton >> 1), gather_bits(morton >> 2)};
}

glm::uvec2 pack_voxel(vec3 color, vec3 normal) {
    const glm::uvec2 n = octahedral(normal, 65534.0f);
    return {color_bits(color), n.x | n.y << 16};
}

glm::uvec2 pack_inner_node(vec3 color, vec3 coverage, vec3 sheet, bool bent) {
    const vec3 part = glm::clamp(sheet / glm::max(coverage, 1e-12f), -1.0f, 1.0f);
    const glm::uvec3 p(part * 31.0f + 31.5f);
    return {color_bits(color) | root_steps(coverage.z, 127.0f) << 24 | (bent ? 1u << 31 : 0u),
            root_steps(coverage.x, 127.0f) | root_steps(coverage.y, 127.0f) << 7 | p.x << 14 | p.y << 20 |
                p.z << 26};
}

void merge_samples(std::vector<VoxelSample>& samples) {
    // Equal places keep their order, so that sums do not depend on the sort.
    std::ranges::stable_sort(samples, {}, &VoxelSample::morton);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples.size();) {
        VoxelSample sum{samples[i].morton, 0.0f, vec3(0.0f), vec3(0.0f)};
        vec3 strongest(0.0f);
        float most = 0.0f;
        for (; i < samples.size() && samples[i].morton == sum.morton; ++i) {
            const VoxelSample& s = samples[i];
            sum.color += s.weight * s.color;
            sum.normal += s.weight * s.normal;
            sum.weight += s.weight;
            if (s.weight > most) most = s.weight, strongest = s.normal;
        }
        sum.color /= sum.weight;
        // Where the two sides of something thin meet, the larger one wins.
        sum.normal = glm::length(sum.normal) > 0.1f * sum.weight ? glm::normalize(sum.normal) : strongest;
        samples[kept++] = sum;
    }
    samples.resize(kept);
}

bool build_tree(std::vector<VoxelSample> samples, Voxels& voxels) {
    assert(!samples.empty());
    merge_samples(samples);
    glm::uvec3 low(largest_voxel_grid), high(0u);
    for (const VoxelSample& s : samples) {
        low = glm::min(low, place_of(s.morton));
        high = glm::max(high, place_of(s.morton) + 1u);
    }
    voxels.depth = std::max<std::uint32_t>(
        1, static_cast<std::uint32_t>(std::bit_width(std::max({high.x, high.y, high.z}) - 1)));
    voxels.box_min = vec3(low), voxels.box_max = vec3(high);
    if (count_nodes(samples, voxels.depth) > shared::VOXEL_MAX_NODES) return false;
    TreeBuilder(samples, voxels.depth, voxels.show_faces).put(voxels);
    return true;
}

}  // namespace foveray::scene
