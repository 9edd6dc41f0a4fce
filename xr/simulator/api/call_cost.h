#pragma once

#include <atomic>

#include "base/time.h"

/// CPU time that the calls of this process spend in the simulator, counted while somebody measures. Time
/// asleep is no CPU time.
namespace foveray::simulator::call_cost {

inline std::atomic<int> measurers = 0;

/// Of all calls and threads since the last time; of the call that runs on this thread up to now.
Nanoseconds take();
/// The rest of the call on this thread counts from now on only.
void skip();

/// Lies around a call's body.
class Scope {
  public:
    Scope() {
        if (measurers > 0) start();
    }
    ~Scope() {
        if (counts_) end();
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

  private:
    void start();
    void end();
    bool counts_ = false;
};

}  // namespace foveray::simulator::call_cost
