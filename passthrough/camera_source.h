#pragma once

#include <mutex>

#include "base/math.h"
#include "passthrough/camera_frame.h"

namespace foveray::passthrough {

/// A slot for one picture: the newest replaces the one before. Its holder and the source may be on two
/// threads.
class NewestFrame {
  public:
    void push(const CameraFramePtr& frame);
    /// Null before the first picture.
    CameraFramePtr get() const;

  private:
    mutable std::mutex mutex_;
    CameraFramePtr frame_;
};

/// A camera, live or recorded.
class CameraSource {
  public:
    virtual ~CameraSource() = default;

    /// Pixels, width × height; the same for every picture of the source.
    virtual uvec2 picture_size() const = 0;
    /// The newest picture that has arrived by `time` (session clock). A recorded source decides this by the
    /// recording's times alone and waits until that picture is decoded, so that replays agree. `time` must
    /// not go backwards: an earlier one returns the newest picture already seen. Null when a live source has
    /// not delivered yet. Throws Fault(BadInput) when a recording cannot be read on.
    CameraFramePtr at(Nanoseconds time);

  protected:
    /// Recorded sources publish what is due here; live ones publish from their own thread instead.
    virtual void deliver_until(Nanoseconds time) = 0;
    void publish(const CameraFramePtr& frame) { newest_.push(frame); }

  private:
    NewestFrame newest_;
};

}  // namespace foveray::passthrough
