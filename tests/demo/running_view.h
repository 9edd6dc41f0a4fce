#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

#include "base/math.h"
#include "tests/demo/run_program.h"

namespace foveray::fakes {

/// `foveray view` on the simulated headset, with validation layers on, until it is told to end.
class RunningView {
  public:
    /// Shows `folder`/scene.json. Pictures are kept only by a runtime that is not foveray's own choice
    /// (`--runtime system`).
    enum class Pictures { Dropped, Kept };
    explicit RunningView(const TemporaryFolder& folder, const std::vector<std::string>& more = {},
                         Pictures pictures = Pictures::Dropped);
    ~RunningView();
    RunningView(const RunningView&) = delete;
    RunningView& operator=(const RunningView&) = delete;

    std::string log() const { return file_bytes(log_); }
    /// Until the log has that; fails the test when it does not come.
    void wait_for(const std::string& part) const;
    /// Pictures::Kept: the middle of the left eye's picture, of a frame that began after now.
    vec3 color_now() const;
    /// Ctrl-C; the exit code.
    int end();

  private:
    std::vector<std::filesystem::path> pictures() const;

    std::filesystem::path log_, captures_;
    pid_t pid_ = 0;
};

}  // namespace foveray::fakes
