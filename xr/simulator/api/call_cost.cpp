#include "xr/simulator/api/call_cost.h"

#include <ctime>

namespace foveray::simulator::call_cost {
namespace {

std::atomic<Nanoseconds> total = 0;
thread_local Nanoseconds started = 0;

Nanoseconds cpu_time_of_thread() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return time.tv_sec * nanoseconds_per_second + time.tv_nsec;
}

}  // namespace

Nanoseconds take() {
    const Nanoseconds now = cpu_time_of_thread();
    const Nanoseconds running = now - started;
    started = now;
    return total.exchange(0) + running;
}

void skip() { started = cpu_time_of_thread(); }

void Scope::start() {
    counts_ = true;
    started = cpu_time_of_thread();
}

void Scope::end() { total += cpu_time_of_thread() - started; }

}  // namespace foveray::simulator::call_cost
