#pragma once

#include <mutex>
#include <vector>

#include "base/math.h"
#include "passthrough/camera_frame.h"

namespace foveray::passthrough {

/// Takes the pictures of a source, on the source's thread.
class FrameSink {
  public:
    virtual ~FrameSink() = default;
    virtual void push(const CameraFramePtr& frame) = 0;
};

/// A slot for one picture: the newest replaces the one before. Its holder and the source may be on two
/// threads.
class NewestFrame : public FrameSink {
  public:
    void push(const CameraFramePtr& frame) override;
    /// Null before the first picture.
    CameraFramePtr get() const;

  private:
    mutable std::mutex mutex_;
    CameraFramePtr frame_;
};

/// A camera, live or recorded, that pushes its pictures into sinks.
class CameraSource {
  public:
    virtual ~CameraSource() = default;

    /// Pixels, width × height; the same for every picture of the source.
    virtual uvec2 picture_size() const = 0;
    /// `sink` must outlive the source; add it before the first call of `at`.
    void add_sink(FrameSink& sink) { sinks_.push_back(&sink); }
    /// The newest picture that has arrived by `time` (session clock). A recorded source decides this by the
    /// recording's times alone and waits until that picture is decoded, so that replays agree. `time` must
    /// not go backwards: an earlier one returns the newest picture already seen. Null when a live source has
    /// not delivered yet. Throws Fault(BadInput) when a recording cannot be read on.
    CameraFramePtr at(Nanoseconds time);

  protected:
    /// Recorded sources publish what is due here; live ones publish from their own thread instead.
    virtual void deliver_until(Nanoseconds time) = 0;
    void publish(const CameraFramePtr& frame);

  private:
    NewestFrame newest_;
    std::vector<FrameSink*> sinks_;
};

}  // namespace foveray::passthrough
