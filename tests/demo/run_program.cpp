#include "tests/demo/run_program.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/headset_profile.h"

namespace foveray::fakes {
std::string file_bytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

ProgramResult run_foveray(const std::vector<std::string>& arguments, std::chrono::seconds limit) {
    const TemporaryFolder folder;
    const std::string out = folder.path() / "out", err = folder.path() / "err";
    ::setenv("FOVERAY_VALIDATION", "1", 1);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_CREAT | O_WRONLY, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_CREAT | O_WRONLY, 0600);
    std::vector<std::string> words = {FOVERAY_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    ProgramResult result;
    const int failed = posix_spawn(&child, FOVERAY_PROGRAM, &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed) return result;
    int status = 0;
    const auto until = std::chrono::steady_clock::now() + limit;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (std::chrono::steady_clock::now() > until) ::kill(child, SIGKILL);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = file_bytes(out);
    result.err = file_bytes(err);
    return result;
}

std::filesystem::path replay_demo(const TemporaryFolder& folder, const std::string& name,
                                  const std::vector<std::string>& more) {
    const std::filesystem::path out = folder.path() / name;
    std::vector<std::string> arguments = {"replay", assets_folder() / "sessions/demo", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_foveray(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("Validation"), std::string::npos) << result.err;
    EXPECT_EQ(result.out, (out / "report.html").string() + "\n");
    return out;
}

}  // namespace foveray::fakes
