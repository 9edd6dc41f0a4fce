#pragma once

#include <atomic>
#include <cstdint>
#include <list>
#include <mutex>
#include <optional>

#include "xr/simulator/api/functions.h"

namespace foveray::simulator {

/// A function that answers with an error and does nothing.
struct FailingCall {
    const FunctionEntry* function = nullptr;
    XrResult error = XR_ERROR_RUNTIME_FAILURE;
    std::uint32_t times = 1;  // always: every call from now on

    static constexpr std::uint32_t always = UINT32_MAX;
};

/// Safe to use from any thread.
class FailingCalls {
  public:
    void add(const FailingCall& call);
    /// What a call of that function answers now; nothing when it does what it should.
    std::optional<XrResult> take(const FunctionEntry& function);

  private:
    std::mutex mutex_;
    std::list<FailingCall> calls_;  // the oldest first
};

/// Something was scripted that makes calls fail; until then they are not looked at.
inline std::atomic<bool> calls_may_fail = false;

/// Of functions that need no instance. The script's own, from `start` on, are in it once.
FailingCalls& failing_calls_of_process();

/// The error that a call answers instead of doing anything: scripted, or as its instance or session is lost.
std::optional<XrResult> scripted_failure(const FunctionEntry& function, std::uint64_t handle) noexcept;
/// XR_SESSION_LOSS_PENDING instead of XR_SUCCESS on a session that is about to be lost.
XrResult with_notice(const FunctionEntry& function, std::uint64_t handle, XrResult result) noexcept;

}  // namespace foveray::simulator
