#pragma once

#include <optional>
#include <string>

#include "render/scene/gltf_document.h"

namespace foveray::scene {

/// Values in a document's JSON, for the extensions that tinygltf keeps as they are. A missing key gives
/// `otherwise`, a value of another type or a number that is not finite as a float a Fault(BadInput).
float number_at(const GltfDocument& document, const Json& object, const std::string& key,
                const std::string& place, float otherwise);
/// An array of `count` numbers.
std::vector<float> numbers_at(const GltfDocument& document, const Json& object, const std::string& key,
                              const std::string& place, const std::vector<float>& otherwise);

/// The extension's object inside `object`, or null.
const Json* extension_of(const Json& object, const std::string& name);

/// The same checks for what tinygltf has parsed.
std::vector<float> finite_floats(const GltfDocument& document, const std::vector<double>& values,
                                 std::size_t count, const std::string& place);

}  // namespace foveray::scene
