#pragma once

#include <cstdint>
#include <optional>

#include "base/session.h"
#include "xr/simulator/script/pattern.h"

namespace foveray::simulator {

/// How well the eye tracker sees.
struct GazeOptions {
    double noise = 0.0;       // root mean square of the error, degrees
    Nanoseconds latency = 0;  // from the measurement to the earliest frame that sees it
    double blinks = 0.0;      // a minute
    Nanoseconds blink = 150 * nanoseconds_per_millisecond;  // how long each is
    std::uint64_t seed = 0;

    bool operator==(const GazeOptions&) const = default;
};

/// The simulated eye tracker: a session's gaze, a pattern's, or straight ahead, seen through the options. A
/// pattern's is measured 200 times a second.
class GazeTracker {
  public:
    GazeTracker(const GazeOptions& options, const std::optional<Pattern>& pattern)
        : options_(options), pattern_(pattern) {}

    /// The newest measurement that is there at `time`.
    GazeSample at(const Session& session, Nanoseconds time) const;
    /// The newest valid one; nothing before any.
    std::optional<GazeSample> last_valid_at(const Session& session, Nanoseconds time) const;

  private:
    GazeSample measured(const Session& session, Nanoseconds time) const;
    GazeSample with_noise(GazeSample sample) const;
    /// When the blink of that time began.
    std::optional<Nanoseconds> blink_at(Nanoseconds time) const;

    GazeOptions options_;
    std::optional<Pattern> pattern_;
};

}  // namespace foveray::simulator
