#pragma once

#include <filesystem>
#include <string_view>

#include <nlohmann/json.hpp>

namespace foveray {

using Json = nlohmann::json;

/// Throws Fault(BadInput) with file and line when the file is missing or is no JSON.
Json read_json(const std::filesystem::path& file);
/// Checks `document` against a JSON Schema (draft 7) and throws Fault(BadInput) naming `file`, the place
/// inside it, what is expected there and the remedy, as in "scene.json: /lights/0/color: must be a list, not
/// 3 (correct the value)".
void check_json(const Json& document, std::string_view schema_text, const std::filesystem::path& file);
/// A float as the shortest number that reads back as the same float: 0.9746, not 0.9746000170707703.
Json shortest(float value);
void write_json(const std::filesystem::path& file, const Json& document);

}  // namespace foveray
