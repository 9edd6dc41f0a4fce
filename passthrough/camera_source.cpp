#include "passthrough/camera_source.h"

namespace foveray::passthrough {

void NewestFrame::push(const CameraFramePtr& frame) {
    const std::lock_guard lock(mutex_);
    frame_ = frame;
}

CameraFramePtr NewestFrame::get() const {
    const std::lock_guard lock(mutex_);
    return frame_;
}

CameraFramePtr CameraSource::at(Nanoseconds time) {
    deliver_until(time);
    return newest_.get();
}

}  // namespace foveray::passthrough
