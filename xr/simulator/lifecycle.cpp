#include "xr/simulator/lifecycle.h"

#include "xr/simulator/api/verify.h"

namespace foveray::simulator {

// READY, SYNCHRONIZED, VISIBLE and FOCUSED are neighbours in this order, which `walk_to` relies on.
static_assert(XR_SESSION_STATE_READY + 1 == XR_SESSION_STATE_SYNCHRONIZED &&
              XR_SESSION_STATE_SYNCHRONIZED + 1 == XR_SESSION_STATE_VISIBLE &&
              XR_SESSION_STATE_VISIBLE + 1 == XR_SESSION_STATE_FOCUSED);

void Lifecycle::enter(XrSessionState state) {
    state_ = state;
    announce_(state);
}

void Lifecycle::walk_to(XrSessionState target) {
    while (state_ != target) enter(static_cast<XrSessionState>(state_ < target ? state_ + 1 : state_ - 1));
}

void Lifecycle::start() {
    enter(XR_SESSION_STATE_IDLE);
    enter(XR_SESSION_STATE_READY);
}

void Lifecycle::begin() {
    verify(!running_, XR_ERROR_SESSION_RUNNING);
    verify(state_ == XR_SESSION_STATE_READY, XR_ERROR_SESSION_NOT_READY);
    running_ = true;
}

void Lifecycle::show(Script::Presence presence) {
    if (!running_ || stopping() || lost()) return;
    switch (presence) {
        case Script::Presence::Focused:
            return walk_to(XR_SESSION_STATE_FOCUSED);
        case Script::Presence::Visible:
            return walk_to(XR_SESSION_STATE_VISIBLE);
        case Script::Presence::Hidden:
            return walk_to(XR_SESSION_STATE_SYNCHRONIZED);
    }
}

void Lifecycle::lose() {
    if (!lost()) enter(XR_SESSION_STATE_LOSS_PENDING);
}

void Lifecycle::ask_to_stop(Stop stop) {
    verify(running_, XR_ERROR_SESSION_NOT_RUNNING);
    if (stop == Stop::ForGood) stops_for_good_ = true;
    if (stopping() || lost()) return;
    walk_to(XR_SESSION_STATE_SYNCHRONIZED);
    enter(XR_SESSION_STATE_STOPPING);
}

void Lifecycle::end() {
    verify(running_, XR_ERROR_SESSION_NOT_RUNNING);
    verify(stopping(), XR_ERROR_SESSION_NOT_STOPPING);
    running_ = false;
    enter(XR_SESSION_STATE_IDLE);
    enter(stops_for_good_ ? XR_SESSION_STATE_EXITING : XR_SESSION_STATE_READY);
}

}  // namespace foveray::simulator
