#include "app/progress.h"

#include <sstream>

#include <gtest/gtest.h>

namespace foveray::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const Progress::Clock::time_point start{};

TEST(Progress, BarShowsShareAndTimeLeftOnOneLine) {
    std::ostringstream out;
    Progress progress(out, Progress::Style::Bar, "frames", 100, start);
    progress.update(25, start + seconds(50));
    EXPECT_EQ(out.str(), "\r[#######.......................] 25 of 100 frames, about 2 min 30 s left");
    progress.update(26, start + seconds(50) + milliseconds(10));  // too soon to redraw
    EXPECT_EQ(out.str().find("26"), std::string::npos);
    progress.update(100, start + seconds(90));
    progress.finish(start + seconds(90));
    const std::string text = out.str();
    EXPECT_NE(text.find("\r[##############################] 100 of 100 frames in 1 min 30 s"),
              std::string::npos);
    EXPECT_EQ(text.find('\n'), text.size() - 1);
}

TEST(Progress, BarWipesALongerTextBefore) {
    std::ostringstream out;
    Progress progress(out, Progress::Style::Bar, "frames", 10, start);
    progress.update(1, start + seconds(100));
    const std::size_t longest = out.str().size();
    out.str("");
    progress.update(9, start + seconds(101));
    EXPECT_EQ(out.str().size(), longest);
    EXPECT_EQ(out.str().back(), ' ');
}

TEST(Progress, LogGetsALineNowAndThen) {
    std::ostringstream out;
    Progress progress(out, Progress::Style::Lines, "frames", 100, start);
    for (int s = 0; s <= 25; ++s) progress.update(static_cast<std::uint64_t>(s), start + seconds(s));
    EXPECT_EQ(out.str(),
              "10 of 100 frames, about 1 min 30 s left\n20 of 100 frames, about 1 min 20 s left\n");
    progress.finish(start + seconds(26));
    EXPECT_NE(out.str().find("25 of 100 frames in 26 s\n"), std::string::npos);
}

TEST(Progress, SilentSaysNothing) {
    std::ostringstream out;
    Progress progress(out, Progress::Style::Silent, "frames", 2, start);
    progress.update(1, start + seconds(60));
    progress.finish(start + seconds(61));
    EXPECT_EQ(out.str(), "");
    EXPECT_EQ(Progress::style_for(true), Progress::Style::Silent);
}

}  // namespace
}  // namespace foveray::app
