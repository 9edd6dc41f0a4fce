#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/scene/mesh.h"

namespace foveray::scene {

/// Convex solids of unit size, centred at the origin: radius 1, half-sizes 1, a cylinder round the y axis.
enum class CsgPrimitive : std::uint8_t { Sphere, Box, Cylinder };
enum class CsgOperation : std::uint8_t { Union, Intersection, Difference };

struct CsgLeaf {
    CsgPrimitive primitive = CsgPrimitive::Sphere;
    mat4 object_from_leaf{1.0f};         // affine and invertible; holds the leaf's size too
    std::optional<MaterialId> material;  // of surfaces that come from this leaf; absent: the shape's
};

/// One step of a program in postfix order: puts a leaf on the stack, or replaces its two topmost solids by
/// one.
struct CsgStep {
    std::optional<CsgOperation> operation;
    std::uint32_t leaf = 0;  // without an operation
};

/// Constructive solid geometry: a tree of regularised set operations over convex leaves (Requicha 1980).
struct CsgSolid {
    static constexpr std::size_t most_leaves = 16;

    std::vector<CsgLeaf> leaves;
    std::vector<CsgStep> program;  // leaves exactly one solid on the stack; each leaf is used once
};

/// Object-space bounds. Empty when the operations leave nothing that the leaves' bounds can tell.
Aabb bounds_of(const CsgSolid& solid);

}  // namespace foveray::scene
