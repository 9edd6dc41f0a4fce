#include "app/progress.h"

#include <algorithm>
#include <ostream>
#include <unistd.h>

namespace foveray::app {
namespace {

using Clock = Progress::Clock;

constexpr auto bar_interval = std::chrono::milliseconds(100);
constexpr auto line_interval = std::chrono::seconds(10);
constexpr std::uint64_t bar_width = 30;

std::string duration_text(std::chrono::duration<double> duration) {
    const auto seconds = static_cast<std::int64_t>(duration.count() + 0.5);
    if (seconds < 60) return std::to_string(seconds) + " s";
    const std::string rest = std::to_string(seconds % 60);
    return std::to_string(seconds / 60) + " min " + (rest.size() < 2 ? "0" : "") + rest + " s";
}

}  // namespace

Progress::Style Progress::style_for(bool json) {
    if (json) return Style::Silent;
    return ::isatty(STDERR_FILENO) ? Style::Bar : Style::Lines;
}

Progress::Progress(std::ostream& out, Style style, std::string what, std::uint64_t total,
                   Clock::time_point now)
    : out_(out), style_(style), what_(std::move(what)), total_(total), start_(now), last_drawn_(now) {}

void Progress::update(std::uint64_t done, Clock::time_point now) {
    done_ = std::min(done, total_);
    const auto interval =
        style_ == Style::Bar ? Clock::duration(bar_interval) : Clock::duration(line_interval);
    if (style_ == Style::Silent || now - last_drawn_ < interval) return;
    last_drawn_ = now;
    draw(done_, now, false);
}

void Progress::finish(Clock::time_point now) {
    if (style_ == Style::Silent) return;
    draw(done_, now, true);
    if (style_ == Style::Bar) out_ << std::endl;
    style_ = Style::Silent;
}

void Progress::draw(std::uint64_t done, Clock::time_point now, bool last) {
    const std::chrono::duration<double> elapsed = now - start_;
    std::string text;
    if (style_ == Style::Bar) {
        const std::uint64_t filled = total_ == 0 ? bar_width : done * bar_width / total_;
        text = "[" + std::string(filled, '#') + std::string(bar_width - filled, '.') + "] ";
    }
    text += std::to_string(done) + " of " + std::to_string(total_) + " " + what_;
    if (last) {
        text += " in " + duration_text(elapsed);
    } else if (done > 0) {
        const double left = elapsed.count() * static_cast<double>(total_ - done) / static_cast<double>(done);
        text += ", about " + duration_text(std::chrono::duration<double>(left)) + " left";
    }
    if (style_ == Style::Bar) {
        const std::size_t width = text.size();
        text.resize(std::max(width, last_width_), ' ');  // wipes the longer text before
        last_width_ = width;
        out_ << '\r' << text << std::flush;
    } else {
        out_ << text << std::endl;
    }
}

}  // namespace foveray::app
