#pragma once

#include <vector>

#include "base/json.h"
#include "render/scene/scene.h"

namespace foveray::user_shapes {

constexpr const char* probe_command = "probe-shape";
// Lines of the child, before the last one with its answer.
constexpr const char* probe_prepares = "prepares";  // device and driver are at work
constexpr const char* probe_runs = "runs";          // the shape itself is

/// A moment of an object with the user's shape.
struct ProbeMoment {
    scene::Shape shape;  // with the moment's values
    float seconds = 0.0f;
};

struct ProbeRequest {
    scene::UserShape user;
    std::vector<ProbeMoment> moments;
};

/// What stands on the child's standard input.
Json to_json(const ProbeRequest& request);
ProbeRequest from_json(const Json& json);

/// The moments to look at of all objects with a file: the start, and some through what is animated.
ProbeRequest make_request(const scene::Scene& scene, const scene::UserShape& user, scene::UserShapeId id);

}  // namespace foveray::user_shapes
