#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/scene_values.h"
#include "render/scene/shape.h"

/// Named numbers of shapes and meshes in a scene file. Faults are Fault(BadInput) with file and place.
namespace foveray::scene {

/// A remedy that names the nearest of the names, and all.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> names);

/// The "parameters" of `object` over the values where it says nothing of them.
void read_parameters(const SceneValues& values, const Json& object, const std::string& place,
                     std::span<const ShapeParameter> parameters, std::vector<float>& into);
/// Faults with the nearest name where there is none of this name.
const ShapeParameter& parameter_named(const SceneValues& values, std::span<const ShapeParameter> parameters,
                                      const std::string& name, const std::string& place);
/// A parameter's value, in its range.
std::vector<float> read_numbers(const SceneValues& values, const Json& value, const ShapeParameter& parameter,
                                const std::string& place);

}  // namespace foveray::scene
