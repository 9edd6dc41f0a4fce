#include "render/scene/scene_parameters.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "base/text.h"

namespace foveray::scene {
namespace {

std::string list_of(std::span<const std::string_view> names) {
    std::string list;
    for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

}  // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string_view> names) {
    if (names.empty()) return "leave it out";
    return "did you mean \"" + std::string(nearest(word, names)) + "\"? There are " + list_of(names);
}

void read_parameters(const SceneValues& values, const Json& object, const std::string& place,
                     std::span<const ShapeParameter> parameters, std::vector<float>& into) {
    const Json given = object.value("parameters", Json::object());
    for (const auto& [name, value] : given.items()) {
        const std::string at = place + "/parameters/" + name;
        const ShapeParameter& parameter = parameter_named(values, parameters, name, at);
        const std::vector<float> read = read_numbers(values, value, parameter, at);
        std::ranges::copy(read, into.begin() + *parameter_offset(parameters, name));
    }
}

const ShapeParameter& parameter_named(const SceneValues& values, std::span<const ShapeParameter> parameters,
                                      const std::string& name, const std::string& place) {
    std::vector<std::string_view> names;
    for (const ShapeParameter& p : parameters) {
        if (p.name == name) return p;
        names.push_back(p.name);
    }
    values.fault(place, "is no parameter of this shape", did_you_mean(name, names));
}

std::vector<float> read_numbers(const SceneValues& values, const Json& value, const ShapeParameter& parameter,
                                const std::string& place) {
    const Json list = value.is_array() ? value : Json::array({value});
    if (list.size() != parameter.width) {
        values.fault(place, "has " + std::to_string(list.size()) + " numbers",
                     "give " + std::to_string(parameter.width));
    }
    std::vector<float> result;
    for (const Json& number : list) {
        result.push_back(number.get<float>());
        if (result.back() >= parameter.least && result.back() <= parameter.most) continue;
        values.fault(place, number.dump() + " is out of range",
                     fmt::format("give {} to {}", parameter.least, parameter.most));
    }
    const bool no_length = std::ranges::all_of(result, [](float x) { return std::abs(x) < 1e-3f; });
    if (parameter.rotation && no_length) {
        values.fault(place, "is no rotation", "give a quaternion x, y, z, w");
    }
    return result;
}

}  // namespace foveray::scene
