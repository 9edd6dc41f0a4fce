#include "render/scene/gltf_values.h"

#include <cmath>

namespace foveray::scene {
namespace {

float finite(const GltfDocument& document, double value, const std::string& place) {
    const auto as_float = static_cast<float>(value);
    if (!std::isfinite(as_float)) document.fault(place, "is too large a number");
    return as_float;
}

}  // namespace

float number_at(const GltfDocument& document, const Json& object, const std::string& key,
                const std::string& place, float otherwise) {
    if (!object.contains(key)) return otherwise;
    if (!object[key].is_number()) document.fault(place + "/" + key, "must be a number");
    return finite(document, object[key].get<double>(), place + "/" + key);
}

std::vector<float> numbers_at(const GltfDocument& document, const Json& object, const std::string& key,
                              const std::string& place, const std::vector<float>& otherwise) {
    if (!object.contains(key)) return otherwise;
    const Json& list = object[key];
    const std::string where = place + "/" + key;
    if (!list.is_array() || list.size() != otherwise.size()) {
        document.fault(where, "must be an array of " + std::to_string(otherwise.size()) + " numbers");
    }
    std::vector<float> out;
    for (const Json& value : list) {
        if (!value.is_number()) document.fault(where, "must hold numbers");
        out.push_back(finite(document, value.get<double>(), where));
    }
    return out;
}

const Json* extension_of(const Json& object, const std::string& name) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return nullptr;
    const auto extension = extensions->find(name);
    return extension != extensions->end() && extension->is_object() ? &*extension : nullptr;
}

std::vector<float> finite_floats(const GltfDocument& document, const std::vector<double>& values,
                                 std::size_t count, const std::string& place) {
    if (values.size() != count) document.fault(place, "must have " + std::to_string(count) + " numbers");
    std::vector<float> out;
    for (const double value : values) out.push_back(finite(document, value, place));
    return out;
}

}  // namespace foveray::scene
