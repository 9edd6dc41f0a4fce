#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <string>

namespace foveray::app {

/// Tells a waiting user how far long work is. Output for people only; nothing that is computed depends on it.
class Progress {
  public:
    enum class Style {
        Bar,     // one line, redrawn, for a terminal
        Lines,   // a line every ten seconds, for a log
        Silent,  // for --json
    };
    using Clock = std::chrono::steady_clock;

    /// Bar when standard error is a terminal.
    static Style style_for(bool json);

    /// `what` names one unit of the work in the plural: "frames".
    Progress(std::ostream& out, Style style, std::string what, std::uint64_t total,
             Clock::time_point now = Clock::now());
    /// `done` units are finished.
    void update(std::uint64_t done, Clock::time_point now = Clock::now());
    /// Ends the bar's line; call it before anything else is printed.
    void finish(Clock::time_point now = Clock::now());

  private:
    void draw(std::uint64_t done, Clock::time_point now, bool last);

    std::ostream& out_;
    Style style_;
    std::string what_;
    std::uint64_t total_, done_ = 0;
    Clock::time_point start_, last_drawn_;
    std::size_t last_width_ = 0;
};

}  // namespace foveray::app
