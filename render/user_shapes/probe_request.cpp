#include "render/user_shapes/probe_request.h"

#include <algorithm>

#include "render/scene/animator.h"

namespace foveray::user_shapes {
namespace {

constexpr int looks = 8;                    // through the animations
constexpr std::size_t most_objects = 512;   // that are looked at as they start
constexpr std::size_t most_moments = 32;    // of all objects together, of their animations
constexpr float otherwise_seconds = 10.0f;  // where only `time` moves the shape

Json vector_json(vec3 v) { return {v.x, v.y, v.z}; }
vec3 json_vector(const Json& json) {
    return {json[0].get<float>(), json[1].get<float>(), json[2].get<float>()};
}

Json moment_json(const ProbeMoment& moment) {
    return {{"min", vector_json(moment.shape.user_bounds.min)},
            {"max", vector_json(moment.shape.user_bounds.max)},
            {"own_time", moment.shape.user_time},
            {"values", moment.shape.values},
            {"seconds", moment.seconds}};
}

}  // namespace

Json to_json(const ProbeRequest& request) {
    Json values = Json::array(), moments = Json::array();
    for (const scene::UserValue& v : request.user.values)
        values.push_back({{"name", v.name}, {"width", v.width}});
    for (const ProbeMoment& moment : request.moments) moments.push_back(moment_json(moment));
    return {{"file", request.user.code.file.string()},
            {"text", request.user.code.text},
            {"values", values},
            {"moments", moments}};
}

ProbeRequest from_json(const Json& json) {
    ProbeRequest request;
    request.user.code = scene::parse_user_shape(json["file"].get<std::string>(), json["text"]);
    for (const Json& v : json["values"]) request.user.values.push_back({v["name"], v["width"]});
    for (const Json& m : json["moments"]) {
        ProbeMoment moment;
        moment.shape.kind = scene::ShapeKind::User;
        moment.shape.user_bounds = {json_vector(m["min"]), json_vector(m["max"])};
        moment.shape.user_time = m["own_time"];
        moment.shape.values = m["values"].get<std::vector<float>>();
        moment.seconds = m["seconds"];
        request.moments.push_back(std::move(moment));
    }
    return request;
}

ProbeRequest make_request(const scene::Scene& scene, const scene::UserShape& user, scene::UserShapeId id) {
    float longest = user.code.uses_time() ? otherwise_seconds : 0.0f;
    for (const scene::Animation& animation : scene.animations)
        longest = std::max(longest, animation.duration);
    ProbeRequest request{user, {}};
    std::vector<Json> known;
    scene::SceneAnimator animator(scene);
    for (int i = 0; i < looks; ++i) {
        const float seconds = longest * static_cast<float>(i) / static_cast<float>(looks);
        const auto& changes = animator.advance(static_cast<Nanoseconds>(static_cast<double>(seconds) * 1e9));
        for (scene::ShapeId shape = 0; shape < scene.shapes.size(); ++shape) {
            if (scene.shapes[shape].kind != scene::ShapeKind::User || scene.shapes[shape].user != id)
                continue;
            ProbeMoment moment{scene.shapes[shape], user.code.uses_time() ? seconds : 0.0f};
            moment.shape.values = changes.shapes[shape].values;
            const Json json = moment_json(moment);
            if (std::ranges::find(known, json) != known.end()) continue;
            if (known.size() >= (i == 0 ? most_objects : most_moments)) continue;
            known.push_back(json);
            request.moments.push_back(std::move(moment));
        }
    }
    return request;
}

}  // namespace foveray::user_shapes
