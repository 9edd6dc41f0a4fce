#include "render/scene/voxelize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "render/scene/animator.h"
#include "render/scene/deform.h"
#include "render/scene/singular.h"
#include "render/scene/texture_sampler.h"

namespace foveray::scene {
namespace {

/// A convex piece of a triangle: points in voxels with their barycentric coordinates.
struct Piece {
    struct Point {
        vec3 place, weight;
    };
    std::array<Point, 9> points;  // a triangle cut by six planes
    std::uint32_t count = 0;

    void add(const Point& p) {
        if (count < points.size()) points[count++] = p;
    }
};

/// Cuts a piece at `plane` along `axis` into what is below and above it.
void cut(const Piece& piece, int axis, float plane, Piece& below, Piece& above) {
    below.count = above.count = 0;
    for (std::uint32_t i = 0; i < piece.count; ++i) {
        const Piece::Point &a = piece.points[i], &b = piece.points[(i + 1) % piece.count];
        const float from = a.place[axis] - plane, to = b.place[axis] - plane;
        if (from <= 0.0f) below.add(a);
        if (from >= 0.0f) above.add(a);
        if ((from < 0.0f && to > 0.0f) || (from > 0.0f && to < 0.0f)) {
            const float t = from / (from - to);
            Piece::Point crossing{glm::mix(a.place, b.place, t), glm::mix(a.weight, b.weight, t)};
            crossing.place[axis] = plane;
            below.add(crossing);
            above.add(crossing);
        }
    }
}

/// Calls `act(piece, cell)` for each part of the piece between neighbouring whole numbers along the axis.
template <class Act>
void slice(const Piece& piece, int axis, int cells, const Act& act) {
    float low = piece.points[0].place[axis], high = low;
    for (std::uint32_t i = 1; i < piece.count; ++i) {
        low = std::min(low, piece.points[i].place[axis]);
        high = std::max(high, piece.points[i].place[axis]);
    }
    const int first = std::clamp(static_cast<int>(std::floor(low)), 0, cells - 1);
    // A piece that only touches the next cell is not in it.
    const int last = std::clamp(static_cast<int>(std::ceil(high)) - 1, first, cells - 1);
    Piece rest = piece, below, above;
    for (int cell = first; cell < last; ++cell) {
        cut(rest, axis, static_cast<float>(cell + 1), below, above);
        if (below.count >= 3) act(below, cell);
        if (above.count < 3) return;
        rest = above;
    }
    act(rest, last);
}

struct Part {
    const Primitive* primitive = nullptr;
    DeformedVertices vertices;
    mat4 world{1.0f};
};

std::vector<Part> parts_at_rest(const Scene& scene) {
    std::vector<Part> parts;
    SceneAnimator animator(scene);
    const SceneChanges& start = animator.advance(0);
    for (InstanceId id = 0; id < scene.instances.size(); ++id) {
        const Instance& instance = scene.instances[id];
        for (const Primitive& p : scene.meshes[instance.mesh].primitives) {
            Part part{&p, {}, start.instances[id].world_from_object};
            if (instance.deformation) {
                const DeformationState& s = start.deformations[*instance.deformation];
                part.vertices = deform(p, s.joints, s.morph_weights);
            } else {
                part.vertices = {p.positions, p.normals, {}};
            }
            parts.push_back(std::move(part));
        }
    }
    return parts;
}

class Voxelizer {
  public:
    Voxelizer(const Scene& scene, std::uint32_t resolution)
        : scene_(scene), cells_(static_cast<int>(resolution)), parts_(parts_at_rest(scene)) {
        Aabb bounds;
        for (Part& part : parts_) {
            for (const vec3& p : part.vertices.positions) bounds.add(vec3(part.world * vec4(p, 1.0f)));
        }
        if (bounds.empty()) return;
        const vec3 extent = bounds.extent();
        const float longest = std::max({extent.x, extent.y, extent.z});
        size_ = longest > 0.0f ? longest / static_cast<float>(resolution) : 1e-3f;
        origin_ = bounds.min;
        // Along the shorter sides the grid is centred: faces then do not run along the planes between voxels.
        for (int a = 0; a < 3; ++a) {
            origin_[a] -= 0.5f * (std::ceil(extent[a] / size_ - 1e-3f) * size_ - extent[a]);
        }
    }

    std::optional<Voxels> run() {
        for (const Part& part : parts_) add(part);
        if (samples_.empty()) return std::nullopt;
        Voxels voxels;
        voxels.origin = origin_;
        voxels.voxel_size = size_;
        if (!build_tree(std::move(samples_), voxels)) return std::nullopt;
        return voxels;
    }

  private:
    static constexpr std::size_t merge_step = 1u << 22;  // samples: 128 MiB

    struct Triangle {
        const Primitive* primitive = nullptr;
        const Material* material = nullptr;
        const TextureSampler* texture = nullptr;
        std::array<std::uint32_t, 3> corner{};
        std::array<vec3, 3> normal{};
        std::array<vec2, 3> uv{};  // in the texture's picture
        vec2 footprint{0.0f};      // of a voxel
    };

    void add(const Part& part) {
        if (!is_invertible(part.world)) return;
        const Primitive& primitive = *part.primitive;
        const mat3 normal_matrix = glm::transpose(glm::inverse(mat3(part.world)));
        Triangle triangle;
        triangle.primitive = &primitive;
        triangle.material = &scene_.materials[primitive.material];
        triangle.texture = sampler_of(triangle.material->base_color_texture);
        for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
            Piece piece;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t corner = primitive.indices[i + k];
                triangle.corner[k] = corner;
                triangle.normal[k] = glm::normalize(normal_matrix * part.vertices.normals[corner]);
                triangle.uv[k] = uv_of(primitive, triangle.material->base_color_texture, corner);
                const vec3 world(part.world * vec4(part.vertices.positions[corner], 1.0f));
                vec3 weight(0.0f);
                weight[static_cast<int>(k)] = 1.0f;
                piece.add({(world - origin_) / size_, weight});
            }
            const float area = area_of(piece);
            if (!(area > 0.0f)) continue;
            triangle.footprint = footprint_of(triangle, area);
            split(triangle, piece);
            if (samples_.size() >= merge_at_) {
                merge_samples(samples_);
                merge_at_ = samples_.size() + merge_step;
            }
        }
    }

    void split(const Triangle& triangle, const Piece& piece) {
        slice(piece, 0, cells_, [&](const Piece& slab, int x) {
            slice(slab, 1, cells_, [&](const Piece& column, int y) {
                slice(column, 2, cells_,
                      [&](const Piece& part, int z) { add(triangle, part, glm::uvec3(x, y, z)); });
            });
        });
    }

    void add(const Triangle& triangle, const Piece& piece, glm::uvec3 cell) {
        const float area = area_of(piece);
        if (!(area > 0.0f)) return;
        vec3 weight(0.0f);
        for (std::uint32_t i = 0; i < piece.count; ++i) weight += piece.points[i].weight;
        weight /= static_cast<float>(piece.count);
        const vec4 color = color_at(triangle, weight);
        const Material& material = *triangle.material;
        const bool hole = material.alpha_mode == AlphaMode::Mask    ? color.a < material.alpha_cutoff
                          : material.alpha_mode == AlphaMode::Blend ? color.a < 0.5f
                                                                    : false;
        if (hole) return;
        vec3 normal =
            weight.x * triangle.normal[0] + weight.y * triangle.normal[1] + weight.z * triangle.normal[2];
        if (!(glm::dot(normal, normal) > 1e-12f)) normal = triangle.normal[0];
        samples_.push_back({morton_of(cell), area, vec3(color), glm::normalize(normal)});
    }

    vec4 color_at(const Triangle& t, vec3 weight) const {
        vec4 color = t.material->base_color;
        if (t.texture) {
            color *=
                t.texture->sample(weight.x * t.uv[0] + weight.y * t.uv[1] + weight.z * t.uv[2], t.footprint);
        }
        if (!t.primitive->colors.empty()) {
            const std::vector<vec4>& c = t.primitive->colors;
            color *= weight.x * c[t.corner[0]] + weight.y * c[t.corner[1]] + weight.z * c[t.corner[2]];
        }
        return color;
    }

    static vec2 uv_of(const Primitive& primitive, const TextureUse& use, std::uint32_t corner) {
        const std::vector<vec2>& set = use.uv_set == 1 ? primitive.uv1 : primitive.uv0;
        if (!use || set.empty()) return vec2(0.0f);
        return vec2(uv_matrix(use) * vec3(set[corner], 1.0f));
    }

    static float area_of(const Piece& piece) {
        vec3 sum(0.0f);
        for (std::uint32_t i = 2; i < piece.count; ++i) {
            sum += glm::cross(piece.points[i - 1].place - piece.points[0].place,
                              piece.points[i].place - piece.points[0].place);
        }
        return 0.5f * glm::length(sum);
    }

    /// A voxel's width in the texture's picture: the triangle's areas there and in voxels compared.
    static vec2 footprint_of(const Triangle& t, float area_in_voxels) {
        const vec2 a = t.uv[1] - t.uv[0], b = t.uv[2] - t.uv[0];
        return vec2(std::sqrt(0.5f * std::abs(a.x * b.y - a.y * b.x) / area_in_voxels));
    }

    const TextureSampler* sampler_of(const TextureUse& use) {
        if (!use) return nullptr;
        return &samplers_.try_emplace(*use.texture, scene_, *use.texture).first->second;
    }

    const Scene& scene_;
    int cells_;
    std::vector<Part> parts_;
    float size_ = 1.0f;
    vec3 origin_{0.0f};
    std::map<TextureId, TextureSampler> samplers_;
    std::vector<VoxelSample> samples_;
    std::size_t merge_at_ = merge_step;
};

}  // namespace

std::optional<Voxels> voxelize(const Scene& scene, std::uint32_t resolution) {
    return Voxelizer(scene, resolution).run();
}

}  // namespace foveray::scene
