#include "render/scene/scene_animation.h"

#include <algorithm>
#include <cmath>

#include "render/scene/scene_parameters.h"

namespace foveray::scene {
namespace {

constexpr float latest = 1e6f;    // seconds
constexpr float steepest = 1e9f;  // change a second: what becomes of it stays a finite number

/// What a channel may change, with the width and range of its values.
struct Animatable {
    ShapeParameter value;
    AnimatedProperty property;
    std::uint32_t first_value = 0;
};

const std::vector<Animatable>& animatable_of_nodes() {
    static const std::vector<Animatable> all = {
        {{"translation", 3, vec4(0.0f), -1e6f, 1e6f}, AnimatedProperty::Translation},
        {{"rotation", 4, vec4(0.0f), -1.0f, 1.0f, true}, AnimatedProperty::Rotation},
        {{"scale", 3, vec4(1.0f), 1e-6f, 1e6f}, AnimatedProperty::Scale},
    };
    return all;
}

const std::vector<Animatable>& animatable_of_materials() {
    static const std::vector<Animatable> all = {
        {{"base_color", 3, vec4(1.0f), 0.0f, 1.0f}, AnimatedProperty::BaseColor},
        {{"alpha", 1, vec4(1.0f), 0.0f, 1.0f}, AnimatedProperty::Alpha},
        {{"metallic", 1, vec4(0.0f), 0.0f, 1.0f}, AnimatedProperty::Metallic},
        {{"roughness", 1, vec4(0.5f), 0.0f, 1.0f}, AnimatedProperty::Roughness},
        {{"emissive", 3, vec4(0.0f), 0.0f, 1e6f}, AnimatedProperty::Emissive},
        {{"transmission", 1, vec4(0.0f), 0.0f, 1.0f}, AnimatedProperty::Transmission},
    };
    return all;
}

AnimationChannel read_channel(const SceneValues& values, const Json& json, const std::string& place,
                              std::span<const Animatable> animatable) {
    const std::string name = json["property"];
    std::vector<ShapeParameter> names;
    for (const Animatable& a : animatable) names.push_back(a.value);
    const ShapeParameter property = parameter_named(values, names, name, place + "/property");
    const Animatable& found =
        *std::ranges::find(animatable, name, [](const Animatable& a) { return a.value.name; });
    AnimationChannel c;
    c.property = found.property;
    c.first_value = found.first_value;
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
        if (c.times.back() > latest) {
            values.fault(place + "/times", "go beyond 1 000 000 seconds", "make the animation shorter");
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
        if (tangent) range.least = -steepest, range.most = steepest, range.rotation = false;
        std::vector<float> v = read_numbers(values, keys[i], range, place + "/values/" + std::to_string(i));
        if (c.property == AnimatedProperty::Rotation && !tangent) {
            const quat q = rotation_of(v);
            v = {q.x, q.y, q.z, q.w};
        }
        c.values.insert(c.values.end(), v.begin(), v.end());
    }
    return c;
}

/// The "animation" of `object`.
Animation read_animation(const SceneValues& values, const Json& object, const std::string& place,
                         std::span<const Animatable> animatable) {
    const Json channels = object.value("animation", Json::array());
    Animation animation;
    std::vector<std::string> moved;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const std::string at = place + "/animation/" + std::to_string(i);
        const std::string property = channels[i]["property"];
        if (std::ranges::find(moved, property) != moved.end()) {
            values.fault(at + "/property", "\"" + property + "\" is animated twice", "keep one of them");
        }
        moved.push_back(property);
        animation.channels.push_back(read_channel(values, channels[i], at, animatable));
    }
    return animation;
}

}  // namespace

void add_animation(SceneBuilder& builder, const SceneValues& values, const Json& object,
                   const std::string& place, NodeId node, std::span<const ShapeParameter> parameters) {
    std::vector<Animatable> animatable = animatable_of_nodes();
    for (const ShapeParameter& parameter : parameters) {
        animatable.push_back(
            {parameter, AnimatedProperty::ShapeValues, *parameter_offset(parameters, parameter.name)});
    }
    Animation animation = read_animation(values, object, place, animatable);
    animation.name = object.value("name", "object");
    for (AnimationChannel& channel : animation.channels) channel.node = node;
    if (!animation.channels.empty()) builder.add(std::move(animation));
}

void add_material_animation(SceneBuilder& builder, const SceneValues& values, const Json& json,
                            const std::string& place, MaterialId material) {
    Animation animation = read_animation(values, json, place, animatable_of_materials());
    animation.name = "material";
    for (AnimationChannel& channel : animation.channels) channel.material = material;
    if (!animation.channels.empty()) builder.add(std::move(animation));
}

std::vector<Presence> read_presence(const SceneValues& values, const Json& object, const std::string& place) {
    const Json spans = object.value("present", Json::array());
    std::vector<Presence> present;
    for (std::size_t i = 0; i < spans.size(); ++i) {
        constexpr double longest = 1e9;  // seconds
        Presence& span = present.emplace_back();
        const double from = spans[i][0].get<double>();
        const double until = spans[i].size() > 1 ? spans[i][1].get<double>() : longest;
        if (!(from < until && until <= longest)) {
            values.fault(place + "/present/" + std::to_string(i), "ends before it starts",
                         "give seconds from and until, or only from");
        }
        span.from = from_seconds(from);
        if (spans[i].size() > 1) span.until = from_seconds(until);
    }
    return present;
}

}  // namespace foveray::scene
