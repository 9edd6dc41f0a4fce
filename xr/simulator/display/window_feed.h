#pragma once

#include <array>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "xr/simulator/display/compositor.h"
#include "xr/simulator/window/shared_pictures.h"

namespace foveray::simulator {

/// A file descriptor that is closed with its owner. Move-only.
class OwnedDescriptor {
  public:
    OwnedDescriptor() = default;
    explicit OwnedDescriptor(int descriptor) : descriptor_(descriptor) {}
    ~OwnedDescriptor();
    OwnedDescriptor(OwnedDescriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    OwnedDescriptor& operator=(OwnedDescriptor&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    int operator*() const { return descriptor_; }

  private:
    int descriptor_ = -1;
};

/// Starts foveray-simulator-window, which lies beside the library, and gives it the composed pictures. A
/// window that is closed, or cannot be opened, leaves the client alone.
class WindowFeed {
  public:
    /// `pixels`: of both eyes' largest pictures together.
    WindowFeed(Compositor& compositor, std::size_t pixels);
    ~WindowFeed();

    /// The window is there.
    bool is_open() const;
    /// Composes without waiting for the GPU; a thread hands the pictures over when they are done. Does
    /// nothing while it is busy with a frame before.
    void show(const SubmittedFrame& frame, const std::array<EyeDisplay, 2>& eyes);
    /// Hands over pictures that are composed already. Nothing is under way.
    void publish(const SubmittedFrame& frame, const std::array<EyeDisplay, 2>& eyes,
                 const EyePictures& pictures);
    /// Waits until nothing is under way, and lets go of what was shown.
    void settle();
    /// Waits until the GPU does not read the swapchain.
    void release(const Swapchain& swapchain);

  private:
    void share_memory(std::size_t pixels);
    void start_window();
    void hand_over_pictures();
    void write(const std::array<EyeDisplay, 2>& eyes, const Pose& stage_from_head,
               const EyePictures& pictures);

    Compositor& compositor_;
    OwnedDescriptor memory_, connection_;
    std::size_t mapped_size_ = 0;
    SharedPictures* shared_ = nullptr;

    std::mutex mutex_;  // what follows
    std::condition_variable changed_;
    bool busy_ = false, ending_ = false;
    std::array<EyeDisplay, 2> eyes_{};  // of the frame under way
    Pose stage_from_head_;
    std::thread thread_;
};

}  // namespace foveray::simulator
