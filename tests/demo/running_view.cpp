#include "tests/demo/running_view.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/image.h"

namespace foveray::fakes {

namespace {

template <typename Condition>
bool until(const Condition& condition) {
    for (int i = 0; i < 2400; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
}

}  // namespace

RunningView::RunningView(const TemporaryFolder& folder, const std::vector<std::string>& more,
                         Pictures pictures)
    : log_(folder / "log"), captures_(folder / "captures") {
    const bool kept = pictures == Pictures::Kept;
    ::setenv("FOVERAY_VALIDATION", "1", 1);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log_.c_str(), O_CREAT | O_WRONLY, 0600);
    std::vector<std::string> words = {FOVERAY_PROGRAM, "view", (folder / "scene.json").string(), "--runtime",
                                      kept ? "system" : "simulator"};
    const std::pair<const char*, std::string> variables[] = {
        {"XR_RUNTIME_JSON", FOVERAY_SIMULATOR_JSON},
        {"FOVERAY_SIMULATOR_PROFILE", "ci"},
        {"FOVERAY_SIMULATOR_CAPTURE", captures_.string()}};
    if (kept) {
        std::filesystem::create_directory(captures_);
        for (const auto& [name, value] : variables) ::setenv(name, value.c_str(), 1);
    } else {
        words.insert(words.end(), {"--headset", "ci"});
    }
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    EXPECT_EQ(posix_spawn(&pid_, FOVERAY_PROGRAM, &actions, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
    if (kept) {
        for (const auto& [name, value] : variables) ::unsetenv(name);
    }
}

RunningView::~RunningView() {
    if (pid_ > 0) ::kill(pid_, SIGKILL);
}

void RunningView::wait_for(const std::string& part) const {
    EXPECT_TRUE(until([&] { return log().find(part) != std::string::npos; })) << part << "\n" << log();
}

/// What the left eye saw, in the order of time; the last may still be written.
std::vector<std::filesystem::path> RunningView::pictures() const {
    std::vector<std::filesystem::path> result;
    for (const auto& entry : std::filesystem::directory_iterator(captures_)) {
        if (entry.path().filename().string().ends_with("_left.png")) result.push_back(entry.path());
    }
    std::ranges::sort(result);
    return result;
}

vec3 RunningView::color_now() const {
    const std::size_t before = pictures().size();
    const bool shown = until([&] { return pictures().size() > before + 3; });
    EXPECT_TRUE(shown) << log();
    if (!shown) return vec3(-1.0f);
    const Image image = read_image(pictures()[before + 2], 3);
    const std::uint8_t* middle = image.at(image.width / 2, image.height / 2);
    return vec3(middle[0], middle[1], middle[2]) / 255.0f;
}

int RunningView::end() {
    ::kill(pid_, SIGINT);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace foveray::fakes
