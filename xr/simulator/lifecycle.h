#pragma once

#include <functional>

#include <openxr/openxr.h>

#include "xr/simulator/script/script.h"

namespace foveray::simulator {

/// OpenXR 1.0, section 9.3, figure 2: the states of a session. Every state passed through is announced.
class Lifecycle {
  public:
    explicit Lifecycle(std::function<void(XrSessionState)> announce) : announce_(std::move(announce)) {}

    XrSessionState state() const { return state_; }
    /// Between xrBeginSession and xrEndSession.
    bool running() const { return running_; }
    bool stopping() const { return state_ == XR_SESSION_STATE_STOPPING; }
    bool lost() const { return state_ == XR_SESSION_STATE_LOSS_PENDING; }
    bool visible() const { return state_ == XR_SESSION_STATE_VISIBLE || focused(); }
    bool focused() const { return state_ == XR_SESSION_STATE_FOCUSED; }

    /// IDLE, READY.
    void start();
    /// xrBeginSession. Refuses with XR_ERROR_SESSION_RUNNING or XR_ERROR_SESSION_NOT_READY.
    void begin();
    /// Step by step to what the script wants of a running session that was not asked to stop.
    void show(Script::Presence presence);
    /// LOSS_PENDING, from any state, for good.
    void lose();
    /// Why a session is asked to stop: its program shall end, or may go on later.
    enum class Stop { ForGood, Pause };
    /// Step by step to STOPPING. Refuses with XR_ERROR_SESSION_NOT_RUNNING.
    void ask_to_stop(Stop stop);
    /// xrEndSession. Refuses with XR_ERROR_SESSION_NOT_RUNNING or XR_ERROR_SESSION_NOT_STOPPING. IDLE, then
    /// EXITING, or READY after a pause.
    void end();

  private:
    void enter(XrSessionState state);
    void walk_to(XrSessionState target);

    std::function<void(XrSessionState)> announce_;
    XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
    bool running_ = false, stops_for_good_ = false;
};

}  // namespace foveray::simulator
