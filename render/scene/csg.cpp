#include "render/scene/csg.h"

#include <cassert>
#include <cmath>

namespace foveray::scene {
namespace {

/// Of a transformed sphere or cylinder the box is tighter than the box of its transformed box.
Aabb bounds_of(const CsgLeaf& leaf) {
    const mat3 m(leaf.object_from_leaf);
    vec3 half(0.0f);
    for (int row = 0; row < 3; ++row) {
        const vec3 r(m[0][row], m[1][row], m[2][row]);
        half[row] = leaf.primitive == CsgPrimitive::Sphere ? glm::length(r)
                    : leaf.primitive == CsgPrimitive::Box  ? std::abs(r.x) + std::abs(r.y) + std::abs(r.z)
                                                           : std::abs(r.y) + glm::length(vec2(r.x, r.z));
    }
    const vec3 center(leaf.object_from_leaf[3]);
    return {center - half, center + half};
}

Aabb combine(CsgOperation operation, const Aabb& a, const Aabb& b) {
    if (operation == CsgOperation::Difference || (operation == CsgOperation::Union && b.empty())) return a;
    if (operation == CsgOperation::Union) {
        Aabb both = a;
        both.add(b);
        return both;
    }
    const Aabb both{glm::max(a.min, b.min), glm::min(a.max, b.max)};
    return glm::any(glm::greaterThan(both.min, both.max)) ? Aabb{} : both;
}

}  // namespace

Aabb bounds_of(const CsgSolid& solid) {
    std::vector<Aabb> stack;
    for (const CsgStep& step : solid.program) {
        if (!step.operation) {
            stack.push_back(bounds_of(solid.leaves[step.leaf]));
            continue;
        }
        assert(stack.size() >= 2);
        const Aabb b = stack.back();
        stack.pop_back();
        stack.back() = combine(*step.operation, stack.back(), b);
    }
    assert(stack.size() == 1);
    return stack.front();
}

}  // namespace foveray::scene
