#include "render/gpu_solids.h"

namespace foveray::render {
namespace {

static_assert(scene::CsgSolid::most_leaves == shared::CSG_MOST_LEAVES);
static_assert(static_cast<std::uint32_t>(scene::CsgPrimitive::Box) == shared::CSG_BOX &&
              static_cast<std::uint32_t>(scene::CsgPrimitive::Cylinder) == shared::CSG_CYLINDER);
static_assert(shared::CSG_UNION + static_cast<std::uint32_t>(scene::CsgOperation::Intersection) ==
                  shared::CSG_INTERSECTION &&
              shared::CSG_UNION + static_cast<std::uint32_t>(scene::CsgOperation::Difference) ==
                  shared::CSG_DIFFERENCE);

shared::CsgLeaf packed(const scene::CsgLeaf& leaf, const scene::Scene& scene, scene::MaterialId otherwise) {
    shared::CsgLeaf result{};
    result.leaf_from_object = glm::mat4x3(glm::inverse(glm::dmat4(leaf.object_from_leaf)));
    result.kind = static_cast<std::uint32_t>(leaf.primitive);
    result.material = leaf.material.value_or(otherwise);
    result.flags = scene.materials[result.material].double_sided ? 0 : shared::SHAPE_SINGLE_SIDED;
    return result;
}

std::uint32_t packed(const scene::CsgStep& step) {
    return step.operation ? shared::CSG_UNION + static_cast<std::uint32_t>(*step.operation) : step.leaf;
}

}  // namespace

GpuSolids::GpuSolids(gpu::Uploader& uploader, const scene::Scene& scene) {
    std::vector<shared::CsgLeaf> leaves;
    std::vector<std::uint32_t> steps;
    for (const scene::Shape& shape : scene.shapes) {
        Place place;
        place.first_leaf = static_cast<std::uint32_t>(leaves.size());
        place.first_step = static_cast<std::uint32_t>(steps.size());
        place.leaf_count = static_cast<std::uint32_t>(shape.solid.leaves.size());
        place.step_count = static_cast<std::uint32_t>(shape.solid.program.size());
        for (const scene::CsgLeaf& leaf : shape.solid.leaves) {
            leaves.push_back(packed(leaf, scene, shape.material));
        }
        for (const scene::CsgStep& step : shape.solid.program) steps.push_back(packed(step));
        places_.push_back(place);
    }
    if (leaves.empty()) return;
    leaves_ = uploader.buffer("csg leaves", gpu::range_bytes(leaves));
    steps_ = uploader.buffer("csg programs", gpu::range_bytes(steps));
}

shared::CsgRecord GpuSolids::record(const shared::ShapeHeader& header) const {
    const Place& place = places_[header.shape];
    return {header, leaves_.address() + place.first_leaf * sizeof(shared::CsgLeaf),
            steps_.address() + place.first_step * sizeof(std::uint32_t), place.leaf_count, place.step_count};
}

}  // namespace foveray::render
