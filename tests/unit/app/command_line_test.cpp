#include "app/command_line.h"
#include "app/program.h"

#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

namespace foveray::app {
namespace {

template <typename Options>
Options parse(const std::vector<std::string>& arguments) {
    return std::get<Options>(parse_command_line(arguments).command);
}

struct Outcome {
    int code;
    std::string errors;
};

Outcome outcome_of(const std::vector<std::string>& arguments) {
    std::ostringstream errors;
    const int code = run_guarded(errors, [&] {
        parse_command_line(arguments);
        return ExitCode::Done;
    });
    return {code, errors.str()};
}

/// Exit code 2, and one line with every one of `parts`.
void expect_rejected(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
    const Outcome outcome = outcome_of(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.errors;
    EXPECT_EQ(outcome.errors.rfind("foveray: error: ", 0), 0u) << outcome.errors;
    EXPECT_EQ(outcome.errors.find('\n'), outcome.errors.size() - 1) << outcome.errors;
    for (const std::string& part : parts) {
        EXPECT_NE(outcome.errors.find(part), std::string::npos)
            << "no '" << part << "' in " << outcome.errors;
    }
}

TEST(CommandLine, ReplayTakesEveryOption) {
    const auto o = parse<ReplayOptions>({"replay",
                                         "sessions/a b",
                                         "--scene",
                                         "my scene.gltf",
                                         "--camera",
                                         "feed.mp4",
                                         "--calibration",
                                         "c.json",
                                         "--headset",
                                         "varjo-xr1",
                                         "--out",
                                         "result",
                                         "--frames",
                                         "10:20",
                                         "--reference",
                                         "--gpu",
                                         "1",
                                         "--set",
                                         "lighting.shadow_samples=9",
                                         "--set",
                                         "lighting.shadows=off",
                                         "--json"});
    EXPECT_EQ(o.session, "sessions/a b");
    EXPECT_EQ(o.scene, std::filesystem::path("my scene.gltf"));
    EXPECT_EQ(o.camera, "feed.mp4");
    EXPECT_EQ(o.calibration, std::filesystem::path("c.json"));
    EXPECT_EQ(o.headset, "varjo-xr1");
    EXPECT_EQ(o.out, "result");
    EXPECT_EQ(o.frames, (FrameRange{10, 20}));
    EXPECT_TRUE(o.reference);
    EXPECT_EQ(o.gpu, 1u);
    EXPECT_EQ(o.settings.shadow_samples, 9);
    EXPECT_FALSE(o.settings.shadows);
    EXPECT_TRUE(o.json);
}

TEST(CommandLine, ReplayNeedsOnlyASession) {
    const auto o = parse<ReplayOptions>({"replay", "sessions/demo"});
    EXPECT_FALSE(o.scene || o.camera || o.calibration || o.headset || o.frames || o.gpu);
    EXPECT_FALSE(o.reference || o.json);
    EXPECT_EQ(o.out, std::filesystem::path("out/demo"));
    EXPECT_EQ(parse<ReplayOptions>({"replay", "sessions/demo/"}).out, std::filesystem::path("out/demo"));
}

TEST(CommandLine, SetDoesNotSwallowTheSession) {
    EXPECT_EQ(parse<ReplayOptions>({"replay", "--set", "lighting.shadows=off", "a"}).session, "a");
}

TEST(CommandLine, ViewTakesEveryOption) {
    const auto o =
        parse<ViewOptions>({"view", "a.glb", "--runtime", "simulator", "--mirror", "--record", "rec"});
    EXPECT_EQ(o.scene, std::filesystem::path("a.glb"));
    EXPECT_EQ(o.runtime, xr::RuntimeChoice::Simulator);
    EXPECT_TRUE(o.mirror);
    EXPECT_EQ(o.record, std::filesystem::path("rec"));
    EXPECT_EQ(parse<ViewOptions>({"view"}).runtime, xr::RuntimeChoice::Auto);
    EXPECT_EQ(parse<ViewOptions>({"view", "--runtime", "system"}).runtime, xr::RuntimeChoice::System);
}

TEST(CommandLine, ImportDoctorAndSettings) {
    const auto import =
        parse<ImportOptions>({"import", "a.csv", "b.csv", "--from", "vive-pro-eye", "--out", "s"});
    EXPECT_EQ(import.files, (std::vector<std::filesystem::path>{"a.csv", "b.csv"}));
    EXPECT_EQ(import.format, "vive-pro-eye");
    EXPECT_EQ(import.out, "s");
    EXPECT_TRUE(parse<DoctorOptions>({"doctor", "--json"}).json);
    EXPECT_EQ(parse<SettingsOptions>({"settings", "--headset", "ci"}).headset, "ci");
    EXPECT_EQ(parse_command_line({"doctor", "--log-level", "debug"}).log_level, "debug");
}

TEST(CommandLine, HelpOfEveryCommandHasAnExample) {
    const std::string all = parse<Notice>({"--help"}).text;
    for (const std::string command : {"view", "replay", "import", "doctor", "settings"}) {
        EXPECT_NE(all.find("\n  " + command), std::string::npos) << all;
        const std::string text = parse<Notice>({command, "--help"}).text;
        EXPECT_NE(text.find("Example:\n  foveray " + command), std::string::npos) << text;
        EXPECT_NE(text.find("Usage: foveray " + command), std::string::npos) << text;
        EXPECT_EQ(text.find(" :"), std::string::npos) << text;
        EXPECT_NE(text.find("--log-level trace|debug|info|warn|error|off"), std::string::npos) << text;
    }
    EXPECT_EQ(parse<Notice>({"--version"}).text, "foveray " FOVERAY_VERSION "\n");
}

TEST(CommandLine, UnknownArgumentsGetAHint) {
    expect_rejected({}, {"needs a command", "--help"});
    expect_rejected({"reply"}, {"reply", "is no command", "did you mean replay?"});
    expect_rejected({"replay", "a", "--frame", "1:2"},
                    {"--frame", "foveray replay", "did you mean --frames?"});
    expect_rejected({"replay", "--bogus"}, {"--bogus", "is no option"});
    expect_rejected({"replay", "a", "b"}, {"b", "too many"});
    expect_rejected({"doctor", "now"}, {"now", "too many"});
}

TEST(CommandLine, BadValuesNameTheOption) {
    expect_rejected({"replay"}, {"SESSION", "foveray replay --help"});
    for (const std::string range : {"5", "5:", ":5", "5:5", "7:5", "-1:5", "a:b", "1:2:3", "1:2x"}) {
        expect_rejected({"replay", "a", "--frames", range}, {"--frames", "0:90"});
    }
    expect_rejected({"replay", "a", "--set", "lighting.shadow=off"}, {"lighting.shadow", "lighting.shadows"});
    expect_rejected({"replay", "a", "--set", "lighting.shadow_samples=0"},
                    {"lighting.shadow_samples", "between"});
    expect_rejected({"replay", "a", "--set", "nonsense"}, {"nonsense", "KEY=VALUE"});
    expect_rejected({"replay", "a", "--gpu", "first"}, {"--gpu"});
    expect_rejected({"replay", "a", "--gpu", "-1"}, {"--gpu"});
    expect_rejected({"replay", "a", "--out"}, {"--out"});
    expect_rejected({"view", "--runtime", "monado"}, {"--runtime", "simulator"});
    expect_rejected({"import", "a", "--from", "tobii", "--out", "s"}, {"--from", "vive-pro-eye"});
    expect_rejected({"import", "a", "--from", "vive-pro-eye"}, {"--out"});
    expect_rejected({"doctor", "--log-level", "loud"}, {"--log-level", "debug"});
}

TEST(RunGuarded, TurnsErrorsIntoOneLineAndACode) {
    const auto code_of = [](auto thrower, std::string expected) {
        std::ostringstream errors;
        const int code = run_guarded(errors, [&]() -> ExitCode {
            thrower();
            return ExitCode::Difference;
        });
        EXPECT_EQ(errors.str(), expected);
        return code;
    };
    EXPECT_EQ(code_of([] {}, ""), 1);
    EXPECT_EQ(code_of([] { throw_bad_input("a.csv:3", "is odd", "mend it"); },
                      "foveray: error: a.csv:3: is odd (mend it)\n"),
              2);
    EXPECT_EQ(code_of([] { throw_missing("Vulkan", "no device", "install one"); },
                      "foveray: error: Vulkan: no device (install one)\n"),
              3);
    EXPECT_EQ(
        code_of([] { throw std::runtime_error("two\nlines\n"); }, "foveray: error: internal: two lines\n"),
        4);
}

}  // namespace
}  // namespace foveray::app
