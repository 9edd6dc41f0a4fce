#pragma once

// Vulkan first: openxr_platform.h uses its types.
#include "render/gpu/vulkan.h"

#define XR_USE_GRAPHICS_API_VULKAN
#include <string>
#include <utility>

#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include "base/math.h"
#include "base/view.h"

namespace foveray::xr {

/// Throws Fault(Missing) naming the call and the result unless it succeeded. Returns the (success) result.
XrResult check(XrResult result, const char* call);
std::string result_name(XrResult result);

/// Owns an OpenXR object. Move-only.
template <typename T, XrResult (*destroy)(T)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(T handle) : handle_(handle) {}
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : handle_(std::exchange(other.handle_, XR_NULL_HANDLE)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    T get() const { return handle_; }
    T* put() {
        reset();
        return &handle_;
    }
    explicit operator bool() const { return handle_ != XR_NULL_HANDLE; }
    void reset() {
        if (handle_ != XR_NULL_HANDLE) destroy(std::exchange(handle_, XR_NULL_HANDLE));
    }

  private:
    T handle_ = XR_NULL_HANDLE;
};

using InstanceHandle = Handle<XrInstance, xrDestroyInstance>;
using SessionHandle = Handle<XrSession, xrDestroySession>;
using SpaceHandle = Handle<XrSpace, xrDestroySpace>;
using SwapchainHandle = Handle<XrSwapchain, xrDestroySwapchain>;
using ActionSetHandle = Handle<XrActionSet, xrDestroyActionSet>;

Pose to_pose(const XrPosef& pose);
XrPosef to_xr(const Pose& pose);
Fov to_fov(const XrFovf& fov);
XrFovf to_xr(const Fov& fov);

const char* state_name(XrSessionState state);

}  // namespace foveray::xr
