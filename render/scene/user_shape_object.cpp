#include "render/scene/user_shape_object.h"

#include <algorithm>

namespace foveray::scene {
namespace {

constexpr float most = 1e9f;  // of a parameter, either sign

std::vector<UserValue> given_values(const Json& object) {
    std::vector<UserValue> given;  // sorted by name, as JSON objects here are
    const Json parameters = object.value("parameters", Json::object());
    for (const auto& [name, value] : parameters.items()) {
        given.push_back({name, value.is_array() ? static_cast<std::uint32_t>(value.size()) : 1});
    }
    return given;
}

Aabb bounds_of_object(const SceneValues& values, const Json& object, const std::string& place) {
    if (!object.contains("bounds")) {
        values.fault(place, "has no \"bounds\"",
                     R"(give {"min": [x, y, z], "max": [x, y, z]} round the surface)");
    }
    const std::string bounds_place = place + "/bounds";
    const Json& bounds = object["bounds"];
    const Aabb box{values.triple(bounds, "min", bounds_place, vec3(0.0f)),
                   values.triple(bounds, "max", bounds_place, vec3(0.0f))};
    for (int axis = 0; axis < 3; ++axis) {
        const float size = box.max[axis] - box.min[axis];
        if (size < 0.0f)
            values.fault(bounds_place, "are the wrong way round: min is above max", "exchange them");
        if (size < smallest_shape) values.fault(bounds_place, "have no volume", "make max greater than min");
        if (std::max(std::abs(box.min[axis]), std::abs(box.max[axis])) > largest_shape) {
            values.fault(bounds_place, "are too large", "stay within 10000 m and scale the object");
        }
    }
    return box;
}

}  // namespace

Shape read_user_object(SceneBuilder& builder, const SceneValues& values, const Json& object,
                       const std::string& place) {
    if (!object.contains("file"))
        values.fault(place, "has no \"file\"", "name the GLSL file that defines it");
    const std::filesystem::path file = values.path(object["file"]).lexically_normal();
    builder.note_file(file);
    Shape shape;
    shape.kind = ShapeKind::User;
    shape.user_bounds = bounds_of_object(values, object, place);

    const std::vector<UserShape>& known = builder.so_far().user_shapes;
    const auto found = std::ranges::find_if(known, [&](const UserShape& u) { return u.code.file == file; });
    UserShape user = found != known.end() ? *found : UserShape{read_user_shape(file), {}};
    const std::vector<UserValue> given = given_values(object);
    if (const auto misfit = find_misfit(user.code, given)) {
        values.fault(place + "/parameters" + (misfit->value.empty() ? "" : "/" + misfit->value), misfit->what,
                     misfit->remedy);
    }
    if (found != known.end()) {
        shape.user = static_cast<UserShapeId>(found - known.begin());
    } else {
        std::ranges::copy_if(given, std::back_inserter(user.values),
                             [](const UserValue& v) { return v.name != "time"; });
        shape.user = builder.add(std::move(user));
    }
    shape.user_time = std::ranges::find(given, "time", &UserValue::name) != given.end();
    return shape;
}

std::vector<ShapeParameter> user_parameters(const Scene& scene, const Shape& shape) {
    std::vector<ShapeParameter> parameters;
    for (const UserValue& value : scene.user_shapes[shape.user].values) {
        parameters.push_back({value.name, value.width, vec4(0.0f), -most, most});
    }
    if (shape.user_time) parameters.push_back({"time", 1, vec4(0.0f), -most, most});
    return parameters;
}

}  // namespace foveray::scene
