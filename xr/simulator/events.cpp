#include "xr/simulator/events.h"

#include <utility>

namespace foveray::simulator {

void EventQueue::push(XrSession session, const XrEventDataBuffer& data) {
    const std::lock_guard lock(mutex_);
    if (entries_.size() == capacity) {
        entries_.pop_front();
        ++lost_;
    }
    entries_.push_back({session, data});
}

bool EventQueue::pop(XrEventDataBuffer& event) {
    const std::lock_guard lock(mutex_);
    if (lost_ > 0) {
        const XrEventDataEventsLost lost{XR_TYPE_EVENT_DATA_EVENTS_LOST, nullptr, std::exchange(lost_, 0)};
        std::memcpy(&event, &lost, sizeof lost);
        return true;
    }
    if (entries_.empty()) return false;
    event = entries_.front().data;
    entries_.pop_front();
    return true;
}

void EventQueue::forget(XrSession session) {
    const std::lock_guard lock(mutex_);
    std::erase_if(entries_, [&](const Entry& entry) { return entry.session == session; });
}

}  // namespace foveray::simulator
