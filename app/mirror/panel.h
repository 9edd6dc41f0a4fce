#pragma once

#include <array>
#include <cstddef>

#include "app/report/run_report.h"
#include "base/settings.h"

namespace foveray::app {

/// GPU and CPU time of the newest frames, oldest first.
class TimeHistory {
  public:
    static constexpr std::size_t length = 240;

    void add(const FrameMetrics& metrics);
    std::size_t size() const { return size_; }
    float gpu_ms(std::size_t i) const { return gpu_[(next_ + length - size_ + i) % length]; }
    float cpu_ms(std::size_t i) const { return cpu_[(next_ + length - size_ + i) % length]; }

  private:
    std::array<float, length> gpu_{}, cpu_{};
    std::size_t next_ = 0, size_ = 0;
};

/// What the user chose in the mirror window.
struct MirrorState {
    int eye = 0;  // 0 left, 1 right
    bool show_mark = true;
    bool show_panel = true;
    bool wants_close = false;
};

enum class GazeSource { Eyes, Mouse, Nothing };

constexpr float panel_width = 380.0f;

/// Draws the panel into the current Dear ImGui frame, and changes settings as the user moves them.
void draw_panel(MirrorState& state, Settings& settings, const TimeHistory& history,
                const FrameMetrics& newest, GazeSource gaze);

}  // namespace foveray::app
