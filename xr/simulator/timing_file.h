#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>

#include "xr/simulator/frame_clock.h"

namespace foveray::simulator {

/// FOVERAY_SIMULATOR_TIMING: a line a frame that was ended; docs/simulator.md lists the columns. Times of
/// calls are of CLOCK_MONOTONIC. Safe to use from any thread.
class TimingFile {
  public:
    /// Goes on in a file that this process began. Throws Fault(BadInput) naming the variable.
    explicit TimingFile(const std::filesystem::path& file);
    ~TimingFile();
    TimingFile(const TimingFile&) = delete;
    TimingFile& operator=(const TimingFile&) = delete;

    static Nanoseconds now();

    struct End {
        Nanoseconds called = 0;
        std::uint32_t layers = 0;
        std::uint64_t missed_frames = 0;       // of all up to now
        std::optional<double> composition_ms;  // where the frame was composed
    };
    /// xrWaitFrame was called at `called` and returns that frame.
    void waited(const FrameTime& frame, Nanoseconds session_time, Nanoseconds called);
    void begun(const FrameTime& frame);
    /// Within the call, before it returns.
    void ended(const FrameTime& frame, const End& end);

  private:
    struct Row {
        Nanoseconds session_time = 0, wait_called = 0, wait_returned = 0, begun = 0;
    };

    std::mutex mutex_;  // what follows
    std::filesystem::path file_;
    std::ofstream out_;
    bool is_cut_short_ = false;  // and that was told
    std::map<std::uint64_t, Row> rows_;  // by frame; those not ended yet
    std::uint64_t missed_frames_ = 0;
};

}  // namespace foveray::simulator
