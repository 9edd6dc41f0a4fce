#include <regex>

#include "app/report/run_report.h"
#include "base/csv.h"
#include "base/error.h"
#include "tests/unit/app/temporary_folder.h"

namespace foveray::app {
namespace {

class Report : public TemporaryFolder {
  protected:
    static std::vector<FrameMetrics> some_frames(std::size_t count) {
        std::vector<FrameMetrics> frames(count);
        for (std::size_t i = 0; i < count; ++i) {
            FrameMetrics& f = frames[i];
            f.index = 5 + i;
            f.display_time = static_cast<Nanoseconds>(i) * 10'000'000;
            f.gaze_valid = i % 4 != 3;
            f.gaze_yaw_degrees = 1.5f;
            f.gaze_mark[0] = vec2(0.25f, 0.75f);
            f.rays = {.primary = 1000, .shadow = 100 * i, .reflection = 10, .transparent = 1};
            f.polar_size = {64, 48};
            f.stages = {{"sampling", 0.5}, {"primary", 1.0 + static_cast<double>(i)}};
            f.cpu_ms = 3.0;
        }
        return frames;
    }
    static RunInfo some_run() {
        RunInfo run;
        run.title = "demo <1> & more";
        run.scene = "</script><b>scene";
        run.headset = "ci";
        run.rate_hz = 100.0;
        run.view_sizes = {{320, 240}, {320, 240}};
        run.device = "a device";
        set(run.settings, "lighting.shadow_samples=7");
        return run;
    }
};

TEST_F(Report, MetricsHaveARowAFrameAndAColumnAStage) {
    auto frames = some_frames(3);
    frames[2].stages.emplace_back("resolve", 0.25);
    frames[2].stages.erase(frames[2].stages.begin());
    write_metrics(folder_ / "metrics.csv", frames);
    const CsvTable table = CsvTable::read(folder_ / "metrics.csv");
    ASSERT_EQ(table.row_count(), 3u);
    EXPECT_EQ(table.integer(1, table.column("frame")), 6);
    EXPECT_EQ(table.integer(1, table.column("display_time_ns")), 10'000'000);
    EXPECT_TRUE(table.boolean(1, table.column("gaze_valid")));
    EXPECT_EQ(table.number(1, table.column("gaze_yaw_degrees")), 1.5);
    EXPECT_EQ(table.integer(1, table.column("rays_shadow")), 100);
    EXPECT_EQ(table.integer(1, table.column("polar_width")), 64);
    EXPECT_EQ(table.number(1, table.column("primary_ms")), 2.0);
    EXPECT_EQ(table.number(1, table.column("gpu_ms")), 2.5);
    EXPECT_EQ(table.number(1, table.column("cpu_ms")), 3.0);
    EXPECT_EQ(table.number(1, table.column("resolve_ms")), 0.0);
    EXPECT_EQ(table.number(2, table.column("resolve_ms")), 0.25);
    EXPECT_EQ(table.number(2, table.column("sampling_ms")), 0.0);
}

TEST_F(Report, SummaryHasMediansAndTails) {
    const auto frames = some_frames(100);  // primary stage: 1, 2, … 100 ms
    const Json summary = summarize(some_run(), frames);
    EXPECT_EQ(summary["frames"], 100);
    EXPECT_EQ(summary["frames_with_gaze"], 75);
    EXPECT_EQ(summary["stages_gpu_ms"]["primary"]["median"], 50.0);
    EXPECT_EQ(summary["stages_gpu_ms"]["primary"]["p99"], 99.0);
    EXPECT_EQ(summary["stages_gpu_ms"]["primary"]["max"], 100.0);
    EXPECT_EQ(summary["stages_gpu_ms"]["primary"]["mean"], 50.5);
    EXPECT_EQ(summary["gpu_ms"]["median"], 50.5);
    EXPECT_EQ(summary["rays"]["primary"]["median"], 1000.0);
    EXPECT_EQ(summary["rays"]["total"]["max"], 1000.0 + 9900 + 11);
    EXPECT_EQ(summary["settings"]["lighting.shadow_samples"], 7);
    EXPECT_EQ(summary["headset"]["views"][1]["width"], 320);
    EXPECT_EQ(summary["environment"]["device"], "a device");
}

/// Every element is closed in order; the page is written so that this holds for HTML too.
void expect_well_formed(std::string page) {
    const std::regex scripts("(<script[^>]*>)[^]*?(</script>)"), styles("(<style>)[^]*?(</style>)");
    page = std::regex_replace(page, scripts, "$1$2");
    page = std::regex_replace(page, styles, "$1$2");
    std::vector<std::string> open;
    const std::regex tag("<(/?)([a-zA-Z0-9]+)((?:\\s+[\\w:-]+(?:=\"[^\"<]*\")?)*)\\s*(/?)>");
    std::size_t brackets = 0;
    for (std::sregex_iterator it(page.begin(), page.end(), tag), end; it != end; ++it, ++brackets) {
        const std::smatch& m = *it;
        if (m[1].length() > 0) {
            ASSERT_FALSE(open.empty()) << m.str();
            ASSERT_EQ(open.back(), m[2].str());
            open.pop_back();
        } else if (m[4].length() == 0) {
            open.push_back(m[2].str());
        }
    }
    EXPECT_TRUE(open.empty());
    const auto count = [&](char c) {
        return static_cast<std::size_t>(std::count(page.begin(), page.end(), c));
    };
    EXPECT_EQ(count('<'), brackets + 1);  // and the doctype
}

TEST_F(Report, PageIsWellFormedAndFetchesNothingFromElsewhere) {
    write("frames/frame_00005_left.png", "x");
    write("frames/frame_00007_left.png", "x");
    write("video.mp4", "x");
    write_report(folder_, some_run(), some_frames(4));
    const std::string page = read(folder_ / "report.html");
    expect_well_formed(page);
    EXPECT_EQ(page.find("://"), std::string::npos);
    EXPECT_EQ(page.find("src=\"//"), std::string::npos);
    EXPECT_EQ(page.find("{{"), std::string::npos);
    EXPECT_NE(page.find("<title>demo &#60;1&#62; &#38; more"), std::string::npos);
    EXPECT_NE(page.find("<h1>demo &#60;1&#62; &#38; more</h1>"), std::string::npos);
    EXPECT_EQ(page.find("</script><b>"), std::string::npos);

    const std::string mark = "<script type=\"application/json\" id=\"data\">";
    const std::size_t begin = page.find(mark) + mark.size();
    const Json data = Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    EXPECT_EQ(data["summary"], read_json(folder_ / "summary.json"));
    EXPECT_EQ(data["summary"]["run"]["scene"], "</script><b>scene");
    EXPECT_EQ(data["pictures"]["left"],
              Json::parse(R"(["frames/frame_00005_left.png", null, "frames/frame_00007_left.png", null])"));
    EXPECT_FALSE(data["pictures"].contains("right"));
    EXPECT_EQ(data["video"], "video.mp4");
    EXPECT_EQ(data["frames"]["index"], Json::parse("[5, 6, 7, 8]"));
    EXPECT_EQ(data["frames"]["yaw"], Json::parse("[1.5, 1.5, 1.5, null]"));
    EXPECT_EQ(data["frames"]["marks"]["left"][0], Json::parse("[0.25, 0.75]"));
    EXPECT_EQ(data["frames"]["stages"][1]["name"], "primary");
    EXPECT_TRUE(std::filesystem::exists(folder_ / "metrics.csv"));
}

TEST_F(Report, UnwritableFolderIsAFault) {
    EXPECT_THROW(write_metrics(folder_ / "no" / "metrics.csv", some_frames(1)), Fault);
    EXPECT_THROW(write_report(folder_ / "no", some_run(), some_frames(1)), Fault);
}

}  // namespace
}  // namespace foveray::app
