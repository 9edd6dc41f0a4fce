#pragma once

#include <string>
#include <vector>

#include "render/scene/scene_builder.h"

namespace foveray::user_shapes {

/// A scene of one object with a user's shape, at the origin. `values` in the order of `parameters`.
inline scene::Scene user_scene(const std::string& text, std::vector<scene::UserValue> parameters,
                               std::vector<float> values, scene::Aabb bounds = {vec3(-1.0f), vec3(1.0f)},
                               const mat4& transform = mat4(1.0f)) {
    scene::SceneBuilder builder;
    scene::Shape shape;
    shape.kind = scene::ShapeKind::User;
    shape.user = builder.add({scene::parse_user_shape("shape.glsl", text), std::move(parameters)});
    shape.user_bounds = bounds;
    shape.values = std::move(values);
    scene::Node node;
    node.shape = builder.add(std::move(shape));
    node.matrix = transform;
    builder.add(std::move(node));
    scene::Scene scene = std::move(builder).build();
    scene.materials[0].double_sided = true;
    return scene;
}

}  // namespace foveray::user_shapes
