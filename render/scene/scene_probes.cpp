#include "render/scene/scene_probes.h"

#include <algorithm>
#include <string>

namespace foveray::scene {

void add_probes(SceneBuilder& builder, const SceneValues& values, const Json& json) {
    const std::string place = "/probes";
    ProbeGrid grid;
    if (json.contains("counts")) {
        const Json& counts = json["counts"];
        for (int axis = 0; axis < 3; ++axis) grid.counts[axis] = counts[axis].get<std::uint32_t>();
    }
    const std::uint32_t count = grid.counts.x * grid.counts.y * grid.counts.z;
    if (count > ProbeGrid::most) {
        values.fault(
            place + "/counts",
            "makes " + std::to_string(count) + " probes, more than " + std::to_string(ProbeGrid::most),
            "take fewer");
    }
    if (json.contains("center") != json.contains("size")) {
        values.fault(place, "has only one of center and size", "give both, or neither to fit the scene");
    }
    if (json.contains("size")) {
        const vec3 center = values.triple(json, "center", place, vec3(0.0f));
        const vec3 size = values.triple(json, "size", place, vec3(1.0f));
        grid.min = center - 0.5f * size;
        grid.max = center + 0.5f * size;
        const vec3 spacing = (grid.max - grid.min) / vec3(grid.counts);
        if (glm::any(glm::lessThan(spacing, vec3(1e-4f)))) {
            values.fault(place + "/size", "is too small for so many probes", "make it larger");
        }
    } else {
        const Aabb bounds = builder.bounds();
        if (bounds.empty())
            values.fault(place, "has nothing in the scene to be fitted to", "give center and size");
        // A flat scene has light above it.
        const vec3 size = bounds.max - bounds.min;
        const vec3 least(0.05f * std::max({size.x, size.y, size.z, 0.1f}));
        const vec3 grown = glm::max(size, least), center = 0.5f * (bounds.min + bounds.max);
        grid.min = center - 0.5f * grown;
        grid.max = center + 0.5f * grown;
    }
    builder.set(grid);
}

}  // namespace foveray::scene
