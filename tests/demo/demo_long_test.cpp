// What takes minutes: ./test.sh --long.
#include <gtest/gtest.h>

#include "tests/demo/run_program.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;
using fakes::file_bytes;
using fakes::replay_demo;

TEST(Demo, TheWholeSessionTwiceIsTheSameBytes) {
    const fakes::TemporaryFolder folder;
    const fs::path first = replay_demo(folder, "first", {});
    const fs::path second = replay_demo(folder, "second", {});
    for (const auto& entry : fs::directory_iterator(first / "frames")) {
        EXPECT_EQ(file_bytes(entry.path()), file_bytes(second / "frames" / entry.path().filename()))
            << entry.path();
    }
}

}  // namespace
}  // namespace foveray
