#include "xr/simulator/api/failing_calls.h"

#include <algorithm>

#include "base/error.h"
#include "xr/simulator/api/return_codes.h"
#include "xr/simulator/script/faults.h"
#include "xr/simulator/session.h"

namespace foveray::simulator {
namespace {

/// Functions that tell the loss of their instance. The loader asks for functions to destroy a lost one.
bool tells_instance_loss(const FunctionEntry& function) {
    return may_answer(function, XR_ERROR_INSTANCE_LOST) && function.name != "xrGetInstanceProcAddr";
}

std::optional<XrResult> find_failure(const FunctionEntry& function, std::uint64_t handle) {
    object_of_call = handle;
    if (function.owner == Owner::None) return failing_calls_of_process().take(function);
    const auto root = find_root(handle);
    if (!root) return std::nullopt;  // the function itself refuses it
    auto& instance = static_cast<Instance&>(*root);
    if (instance.lost() && tells_instance_loss(function)) return XR_ERROR_INSTANCE_LOST;
    const auto session = find_ancestor(handle, XR_OBJECT_TYPE_SESSION);
    if (session && static_cast<const Session&>(*session).lost() &&
        may_answer(function, XR_ERROR_SESSION_LOST))
        return XR_ERROR_SESSION_LOST;
    const auto failure = instance.failing_calls().take(function);
    if (failure == XR_ERROR_INSTANCE_LOST) instance.note_loss();
    return failure;
}

}  // namespace

void FailingCalls::add(const FailingCall& call) {
    const std::lock_guard lock(mutex_);
    calls_.push_back(call);
}

std::optional<XrResult> FailingCalls::take(const FunctionEntry& function) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(calls_, &function, &FailingCall::function);
    if (found == calls_.end()) return std::nullopt;
    const XrResult error = found->error;
    if (found->times != FailingCall::always && --found->times == 0) calls_.erase(found);
    return error;
}

FailingCalls& failing_calls_of_process() {
    static FailingCalls calls;
    return calls;
}

std::optional<XrResult> scripted_failure(const FunctionEntry& function, std::uint64_t handle) noexcept {
    try {
        if (function.owner == Owner::None) arm_failures_from_start();
        const auto failure = find_failure(function, handle);
        if (failure) tell_refusal(function.name.data(), *failure);
        return failure;
    } catch (...) {
        return result_of_current_exception();
    }
}

XrResult with_notice(const FunctionEntry& function, std::uint64_t handle, XrResult result) noexcept {
    if (result != XR_SUCCESS || function.owner != Owner::Session || function.name.starts_with("xrDestroy"))
        return result;
    const auto session = find_ancestor(handle, XR_OBJECT_TYPE_SESSION);
    const bool notice = session && static_cast<const Session&>(*session).gives_notice();
    return notice ? XR_SESSION_LOSS_PENDING : result;
}

}  // namespace foveray::simulator
