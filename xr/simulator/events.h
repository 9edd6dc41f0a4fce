#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <mutex>

#include <openxr/openxr.h>

namespace foveray::simulator {

/// What xrPollEvent delivers, the oldest first. Safe to use from any thread.
class EventQueue {
  public:
    /// A client that never polls loses the oldest events, and is told how many.
    static constexpr std::size_t capacity = 1000;

    /// `event` is one of the XrEventData structures, of a session or the instance.
    template <typename Event>
    void push(const Event& event) {
        static_assert(sizeof(Event) <= sizeof(XrEventDataBuffer));
        XrEventDataBuffer data;
        std::memcpy(&data, &event, sizeof event);
        if constexpr (requires { event.session; }) {
            push(event.session, data);
        } else {
            push(XR_NULL_HANDLE, data);
        }
    }
    /// False when there is none.
    bool pop(XrEventDataBuffer& event);
    /// The session is gone: its events are not delivered any more.
    void forget(XrSession session);

  private:
    struct Entry {
        XrSession session;
        XrEventDataBuffer data;
    };
    void push(XrSession session, const XrEventDataBuffer& data);

    std::mutex mutex_;
    std::deque<Entry> entries_;
    std::uint32_t lost_ = 0;
};

}  // namespace foveray::simulator
