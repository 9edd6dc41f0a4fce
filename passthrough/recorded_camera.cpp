#include "passthrough/recorded_camera.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace foveray::passthrough {

RecordedCamera::RecordedCamera(std::unique_ptr<PictureReader> reader, Nanoseconds latency)
    : reader_(std::move(reader)), latency_(latency) {}

void RecordedCamera::deliver_until(Nanoseconds time) {
    bool stepped = false;
    auto frame = std::make_shared<CameraFrame>();
    while (next_sequence_ == 0 || offset_ + reader_->time_of(next_index_) + latency_ <= time) {
        if (!reader_->step()) {
            start_again(time);
            continue;
        }
        stepped = true;
        frame->capture_time = offset_ + reader_->time_of(next_index_++);
        frame->sequence = next_sequence_++;
    }
    if (!stepped) return;
    frame->picture = reader_->picture();
    frame->source = reader_->name();
    publish(frame);
}

void RecordedCamera::start_again(Nanoseconds time) {
    if (next_index_ == 0) {
        throw_bad_input(reader_->name(), "holds no picture that can be decoded",
                        "record or convert it again");
    }
    // Whole repetitions that nobody saw (a headset laid aside) are passed over without decoding them.
    const Nanoseconds duration = reader_->time_of(next_index_) - reader_->time_of(0);
    const Nanoseconds behind = time - latency_ - offset_ - reader_->time_of(0);
    const Nanoseconds repetitions = std::max<Nanoseconds>(1, behind / duration);
    offset_ += repetitions * duration;
    next_sequence_ += static_cast<std::uint64_t>(repetitions - 1) * next_index_;
    next_index_ = 0;
    reader_->rewind();
}

}  // namespace foveray::passthrough
