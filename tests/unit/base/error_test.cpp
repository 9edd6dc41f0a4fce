#include "base/error.h"

#include <gtest/gtest.h>

#include "base/text.h"

namespace foveray {
namespace {

TEST(Fault, IsOneLineWithWhereWhatAndRemedy) {
    const Fault fault(ExitCode::BadInput, "a.json: /lights/0", "must be an object", "see the schema");
    EXPECT_STREQ(fault.what(), "a.json: /lights/0: must be an object (see the schema)");
    EXPECT_EQ(static_cast<int>(fault.code()), 2);
}

TEST(Nearest, FindsTheWordThatWasMeant) {
    const std::string_view words[] = {"shadows", "shadow_samples", "reflections"};
    EXPECT_EQ(nearest("shadow", words), "shadows");
    EXPECT_EQ(nearest("reflextions", words), "reflections");
    EXPECT_EQ(nearest("anything", {}), "");
}

}  // namespace
}  // namespace foveray
