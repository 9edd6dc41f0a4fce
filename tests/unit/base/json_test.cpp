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
