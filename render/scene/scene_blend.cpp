#include "render/scene/scene_blend.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

#include "render/scene/shape.h"

namespace foveray::scene {
namespace {

/// The smaller sizes are where the shape has one or two.
BlendPart primitive_of(const SceneValues& values, const Json& json, const std::string& place) {
    BlendPart part;
    int found = 0;
    const auto is = [&](const char* key, BlendPrimitive primitive) {
        if (!json.contains(key)) return false;
        part.primitive = primitive;
        ++found;
        return true;
    };
    const auto number = [&](const char* key, const char* name, float otherwise) {
        return values.number(json[key], name, place + "/" + key, otherwise);
    };
    if (is("sphere", BlendPrimitive::Sphere)) part.size = {number("sphere", "radius", 0.5f), 0.0f, 0.0f};
    if (is("box", BlendPrimitive::Box)) {
        part.size = values.triple(json["box"], "half_size", place + "/box", vec3(0.5f));
    }
    if (is("torus", BlendPrimitive::Torus)) {
        part.size = {number("torus", "radius", 0.4f), number("torus", "tube_radius", 0.1f), 0.0f};
    }
    if (is("capsule", BlendPrimitive::Capsule)) {
        part.size = {number("capsule", "radius", 0.2f), number("capsule", "half_height", 0.3f), 0.0f};
    }
    if (found != 1) {
        values.fault(place, found == 0 ? "is no shape" : "is several shapes at once",
                     "give one of sphere, box, torus, capsule");
    }
    return part;
}

void check_size(const SceneValues& values, const BlendPart& part, const std::string& place) {
    const int sizes = part.primitive == BlendPrimitive::Box      ? 3
                      : part.primitive == BlendPrimitive::Sphere ? 1
                                                                 : 2;
    const vec3 scale = part.object_from_part.scale;
    for (int i = 0; i < sizes; ++i) {
        const float least = part.size[i] * std::min({scale.x, scale.y, scale.z});
        const float most = part.size[i] * std::max({scale.x, scale.y, scale.z});
        if (least >= smallest_shape && most <= largest_shape) continue;
        values.fault(place,
                     fmt::format("has a size of {} with its scale", least < smallest_shape ? least : most),
                     fmt::format("bring it to {} to {}", smallest_shape, largest_shape));
    }
    if (!(glm::length(part.object_from_part.translation) <= 10.0f * largest_shape)) {
        values.fault(place, "is too far from the object's origin", "move the object instead");
    }
}

}  // namespace

std::vector<BlendPart> read_blend_parts(const SceneValues& values, const Json& parts,
                                        const std::string& place) {
    std::vector<BlendPart> result;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string inside = place + "/" + std::to_string(i);
        BlendPart part = primitive_of(values, parts[i], inside);
        const std::string operation = parts[i].value("operation", "union");
        if (operation == "subtract") part.operation = BlendOperation::Subtract;
        if (operation == "intersect") part.operation = BlendOperation::Intersect;
        if (i == 0 && part.operation != BlendOperation::Union) {
            values.fault(inside + "/operation", "there is nothing yet to " + operation, "begin with a union");
        }
        if (parts[i].contains("transform")) {
            part.object_from_part = values.transform(parts[i]["transform"], inside + "/transform");
        }
        part.color = values.triple(parts[i], "color", inside, part.color);
        check_size(values, part, inside);
        result.push_back(part);
    }
    return result;
}

}  // namespace foveray::scene
