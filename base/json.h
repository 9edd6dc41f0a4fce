#pragma once

#include <filesystem>
#include <string_view>

#include <nlohmann/json.hpp>

namespace foveray {

using Json = nlohmann::json;

/// Throws Fault(BadInput) with file and line when the file is missing or is no JSON.
Json read_json(const std::filesystem::path& file);
/// Checks `document` against a JSON Schema (draft 7) and throws Fault(BadInput) naming `file` and the place
/// inside it, as in "scene.json: /lights/0/color: must be an array".
void check_json(const Json& document, std::string_view schema_text, const std::filesystem::path& file);
void write_json(const std::filesystem::path& file, const Json& document);

}  // namespace foveray
