#include "base/staged_folder.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;

TEST(StagedFolder, AppearsWholeOrNotAtAll) {
    const fakes::TemporaryFolder folder;
    const fs::path target = folder.path() / "out";
    {
        StagedFolder staged(target, "summary.json");
        std::ofstream(staged.path() / "summary.json") << "{}";
        EXPECT_FALSE(fs::exists(target));
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
    {
        StagedFolder staged(target, "summary.json");
        std::ofstream(staged.path() / "summary.json") << "{}";
        staged.commit();
    }
    EXPECT_TRUE(fs::exists(target / "summary.json"));
}

TEST(StagedFolder, ReplacesOnlyItsOwn) {
    const fakes::TemporaryFolder folder;
    folder.write("mine/summary.json", "{}");
    folder.write("mine/old.png", "x");
    folder.write("theirs/thesis.txt", "x");
    {
        StagedFolder staged(folder.path() / "mine", "summary.json");
        staged.commit();
    }
    EXPECT_FALSE(fs::exists(folder.path() / "mine/old.png"));
    fakes::expect_fault([&] { StagedFolder staged(folder.path() / "theirs", "summary.json"); },
                        ExitCode::BadInput, "not an earlier result");
    EXPECT_TRUE(fs::exists(folder.path() / "theirs/thesis.txt"));
    folder.write("session/session.json", "{}");
    fakes::expect_fault([&] { StagedFolder staged(folder.path() / "session", "report.html"); },
                        ExitCode::BadInput, "not an earlier result");
    fakes::expect_fault([&] { StagedFolder staged(folder.path() / "theirs/thesis.txt", "summary.json"); },
                        ExitCode::BadInput, "not an earlier result");
}

}  // namespace
}  // namespace foveray
