#include "render/scene/scene_animation.h"

#include <algorithm>
#include <cmath>

#include "render/scene/scene_parameters.h"

namespace foveray::scene {
namespace {

/// What the channel moves, with the width and range of its values.
ShapeParameter animated(const SceneValues& values, const std::string& name, const std::string& place,
                        std::span<const ShapeParameter> parameters, AnimationChannel& channel) {
    std::vector<ShapeParameter> all = {
        {"translation", 3, vec4(0.0f), -1e6f, 1e6f},
        {"rotation", 4, vec4(0.0f), -1.0f, 1.0f, true},
        {"scale", 3, vec4(1.0f), 1e-6f, 1e6f},
    };
    all.insert(all.end(), parameters.begin(), parameters.end());
    const ShapeParameter found = parameter_named(values, all, name, place + "/property");
    channel.property = name == "translation" ? AnimatedProperty::Translation
                       : name == "rotation"  ? AnimatedProperty::Rotation
                       : name == "scale"     ? AnimatedProperty::Scale
                                             : AnimatedProperty::ShapeValues;
    if (channel.property == AnimatedProperty::ShapeValues) {
        channel.first_value = *parameter_offset(parameters, name);
    }
    return found;
}

AnimationChannel read_channel(const SceneValues& values, const Json& json, const std::string& place,
                              NodeId node, std::span<const ShapeParameter> parameters) {
    AnimationChannel c;
    c.node = node;
    const ShapeParameter property = animated(values, json["property"], place, parameters, c);
    c.width = property.width;
    const std::string way = json.value("interpolation", "linear");
    c.interpolation = way == "step"    ? Interpolation::Step
                      : way == "cubic" ? Interpolation::CubicSpline
                                       : Interpolation::Linear;
    for (const Json& time : json["times"]) {
        c.times.push_back(time.get<float>());
        const bool increasing = c.times.size() < 2 || c.times.back() > c.times[c.times.size() - 2];
        if (!increasing || !std::isfinite(c.times.back())) {
            values.fault(place + "/times", "do not increase from key to key", "correct them");
        }
    }
    const Json& keys = json["values"];
    const std::size_t wanted = c.times.size() * (c.interpolation == Interpolation::CubicSpline ? 3 : 1);
    if (keys.size() != wanted) {
        values.fault(place + "/values", "has " + std::to_string(keys.size()) + " values",
                     "give " + std::to_string(wanted) +
                         ": one a time, or for cubic in-tangent, value and out-tangent");
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool tangent = c.interpolation == Interpolation::CubicSpline && i % 3 != 1;
        ShapeParameter range = property;
        if (tangent) range.least = -1e30f, range.most = 1e30f, range.rotation = false;
        std::vector<float> v = read_numbers(values, keys[i], range, place + "/values/" + std::to_string(i));
        if (c.property == AnimatedProperty::Rotation && !tangent) {
            const quat q = rotation_of(v);
            v = {q.x, q.y, q.z, q.w};
        }
        c.values.insert(c.values.end(), v.begin(), v.end());
    }
    return c;
}

}  // namespace

void add_animation(SceneBuilder& builder, const SceneValues& values, const Json& object,
                   const std::string& place, NodeId node, std::span<const ShapeParameter> parameters) {
    const Json channels = object.value("animation", Json::array());
    Animation animation;
    animation.name = object.value("name", "object");
    std::vector<std::string> moved;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const std::string at = place + "/animation/" + std::to_string(i);
        const std::string property = channels[i]["property"];
        if (std::ranges::find(moved, property) != moved.end()) {
            values.fault(at + "/property", "\"" + property + "\" is animated twice", "keep one of them");
        }
        moved.push_back(property);
        animation.channels.push_back(read_channel(values, channels[i], at, node, parameters));
    }
    if (!animation.channels.empty()) builder.add(std::move(animation));
}

}  // namespace foveray::scene
