#pragma once

#include <memory>
#include <string>

#include "passthrough/camera_source.h"

namespace foveray::passthrough {

/// Reads the pictures of a recording in order.
class PictureReader {
  public:
    virtual ~PictureReader() = default;

    virtual const std::string& name() const = 0;
    virtual uvec2 picture_size() const = 0;
    /// When picture `index` was captured, counted from the recording's own zero; the index one past the last
    /// gives the time at which a repetition starts.
    virtual Nanoseconds time_of(std::uint64_t index) const = 0;
    /// Steps to the next picture without making it available; false at the end.
    virtual bool step() = 0;
    /// The picture last stepped to, RGBA. Throws Fault(BadInput) when it cannot be decoded.
    virtual Image picture() = 0;
    /// Back to before the first picture.
    virtual void rewind() = 0;
};

/// Plays a recording by the session's clock and starts it again at its end, for ever. A picture is due once
/// its capture time plus `latency` has come; pictures overtaken by a newer one that is due are dropped. Until
/// the first is due the first is shown.
class RecordedCamera : public CameraSource {
  public:
    RecordedCamera(std::unique_ptr<PictureReader> reader, Nanoseconds latency);

    uvec2 picture_size() const override { return reader_->picture_size(); }

  protected:
    void deliver_until(Nanoseconds time) override;

  private:
    void start_again(Nanoseconds time);

    std::unique_ptr<PictureReader> reader_;
    Nanoseconds latency_;
    Nanoseconds offset_ = 0;        // of this repetition
    std::uint64_t next_index_ = 0;  // in the recording
    std::uint64_t next_sequence_ = 0;
};

}  // namespace foveray::passthrough
