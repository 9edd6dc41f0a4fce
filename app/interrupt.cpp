#include "app/interrupt.h"

#include <csignal>

namespace foveray::app {
namespace {

volatile std::sig_atomic_t flag = 0;

void on_signal(int) {
    flag = 1;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

bool interrupted() { return flag != 0; }

}  // namespace foveray::app
