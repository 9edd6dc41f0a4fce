#pragma once

#include <chrono>
#include <thread>

#include "app/interrupt.h"
#include "xr/client/headset.h"

namespace foveray::app {

/// Brings a loop back that waits for a frame of the headset, and gets none, when an interrupt has come.
class WakeOnInterrupt {
  public:
    explicit WakeOnInterrupt(xr::Headset& headset)
        : thread_([&headset](const std::stop_token& end) {
              // The loop itself sees the interrupt first, as long as frames come.
              for (int periods = 0; periods < patience; periods += interrupted() ? 1 : 0) {
                  if (end.stop_requested()) return;
                  std::this_thread::sleep_for(std::chrono::milliseconds(50));
              }
              headset.wake();
          }) {}

  private:
    static constexpr int patience = 20;
    std::jthread thread_;
};

}  // namespace foveray::app
