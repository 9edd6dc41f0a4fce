#include "base/json.h"

#include <gtest/gtest.h>

#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

using fakes::expect_fault;

constexpr const char* schema = R"({
  "type": "object", "additionalProperties": false, "required": ["lights"],
  "properties": {"lights": {"type": "array", "items": {"type": "object", "required": ["power"],
    "properties": {"power": {"type": "number", "minimum": 0}}}}}
})";

TEST(Json, NamesTheLineOfASyntaxError) {
    const fakes::TemporaryFolder folder;
    expect_fault([&] { read_json(folder.path() / "none.json"); }, ExitCode::BadInput, "cannot be opened");
    expect_fault([&] { read_json(folder.path()); }, ExitCode::BadInput, "cannot be opened");
    expect_fault([&] { read_json(folder.write("a.json", "{\n\"a\": 1,\n}")); }, ExitCode::BadInput,
                 "a.json:3");
}

TEST(Json, SchemaNamesThePlace) {
    EXPECT_NO_THROW(check_json(Json::parse(R"({"lights": [{"power": 2}]})"), schema, "s.json"));
    expect_fault(
        [] { check_json(Json::parse(R"({"lights": [{"power": 1}, {"power": -1}]})"), schema, "s.json"); },
        ExitCode::BadInput, "s.json: /lights/1/power");
    expect_fault([] { check_json(Json::parse(R"({"lights": [], "lamps": 1})"), schema, "s.json"); },
                 ExitCode::BadInput, "lamps");
    expect_fault([] { check_json(Json::parse("[]"), schema, "s.json"); }, ExitCode::BadInput, "s.json");
}

TEST(Json, SchemaSaysWhatWasExpectedInPlainWords) {
    constexpr const char* text = R"({
      "type": "object", "required": ["format"], "additionalProperties": false,
      "properties": {
        "format": {"const": "thing"},
        "size": {"type": "integer", "exclusiveMinimum": 0, "maximum": 8},
        "name": {"type": "string", "minLength": 1},
        "color": {"$ref": "#/definitions/color"},
        "modes": {"type": "array", "minItems": 1, "uniqueItems": true, "items": {"enum": ["a", "b", "c"]}},
        "lamps": {"type": "array", "items": {"type": "object", "required": ["type"],
          "allOf": [{"if": {"properties": {"type": {"const": "spot"}}}, "then": {"$ref": "#/definitions/spot"}}]}},
        "parameters": {"type": "object", "additionalProperties": {"anyOf": [{"type": "number"}, {"type": "boolean"}]}}
      },
      "definitions": {
        "color": {"type": "array", "items": {"type": "number", "minimum": 0}, "minItems": 3, "maxItems": 3},
        "spot": {"type": "object", "additionalProperties": false,
          "properties": {"type": {}, "angle": {"type": "number", "exclusiveMaximum": 90}}}
      }
    })";
    const auto expect = [&](const std::string& rest, const std::string& words) {
        const std::string document = R"({"format": "thing")" + (rest.empty() ? "" : ", " + rest) + "}";
        expect_fault([&] { check_json(Json::parse(document), text, "t.json"); }, ExitCode::BadInput,
                     "t.json: " + words);
    };
    expect(R"("size": "big")", "/size: must be a whole number, not \"big\" (correct the value)");
    expect(R"("size": 0)", "/size: must be above 0, not 0");
    expect(R"("size": 9)", "/size: must be at most 8, not 9");
    expect(R"("name": "")", "/name: is empty");
    expect(R"("color": [1, 2])", "/color: must hold 3 values, not 2");
    expect(R"("color": [1, 2, -1])", "/color/2: must be at least 0, not -1");
    expect(R"("color": "red")", "/color: must be a list, not \"red\"");
    expect(R"("modes": [])", "/modes: must hold at least 1 values, not 0");
    expect(R"("modes": ["a", "a"])", "/modes: holds \"a\" twice");
    expect(R"("modes": ["d"])", "/modes/0: must be \"a\", \"b\" or \"c\", not \"d\"");
    expect(R"("colour": [1, 2, 3])",
           "/: holds \"colour\", which means nothing here (did you mean \"color\"?)");
    expect(R"("lamps": [{}])", "/lamps/0: lacks \"type\" (add it)");
    expect(R"("lamps": [{"type": "spot", "angle": 90}])", "/lamps/0/angle: must be below 90, not 90");
    expect(R"("lamps": [{"type": "spot", "angel": 9}])", "/lamps/0: holds \"angel\"");
    expect(R"("parameters": {"x": []})",
           "/parameters/x: must be a number or must be true or false, not a list");
    expect_fault([&] { check_json(Json::parse(R"({"format": "scene"})"), text, "t.json"); },
                 ExitCode::BadInput, "/format: must be \"thing\", not \"scene\"");
    expect_fault([&] { check_json(Json::parse("{}"), text, "t.json"); }, ExitCode::BadInput,
                 "/: lacks \"format\"");
}

TEST(Json, ShortestReadsBackAsTheSameFloat) {
    EXPECT_EQ(shortest(0.9746f).dump(), "0.9746");
    for (const float value : {0.1f, 1.0f / 3.0f, 1e-9f, 16777216.0f, -2.5f})
        EXPECT_EQ(shortest(value).get<float>(), value);
}

TEST(Json, WritesWhatItReads) {
    const fakes::TemporaryFolder folder;
    const Json json = {{"a", {1, 2.5, "x"}}};
    write_json(folder.path() / "b.json", json);
    EXPECT_EQ(read_json(folder.path() / "b.json"), json);
    expect_fault([&] { write_json(folder.path() / "no/where.json", json); }, ExitCode::BadInput,
                 "cannot be written");
}

}  // namespace
}  // namespace foveray
