#pragma once

#include <cassert>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/gpu/barriers.h"
#include "render/gpu/device.h"
#include "render/gpu/memory.h"
#include "render/gpu/timers.h"

namespace foveray::gpu {

/// What is no longer wanted, but may still be in use on the GPU.
class Released {
  public:
    template <typename T>
    void add(T object) {
        objects_.push_back(std::make_shared<T>(std::move(object)));
    }
    /// The GPU is done with all of it.
    void free() { objects_.clear(); }

  private:
    std::vector<std::shared_ptr<void>> objects_;
};

/// One frame's command buffer in recording, with what a stage needs to record itself.
class Commands {
  public:
    Commands(const Device& device, const vk::raii::CommandBuffer& cmd, GpuTimers* timers,
             Released* released = nullptr)
        : device_(device), cmd_(cmd), timers_(timers), released_(released) {}

    const Device& device() const { return device_; }
    const vk::raii::CommandBuffer& vk() const { return cmd_; }
    const vk::raii::CommandBuffer* operator->() const { return &cmd_; }
    void barrier(Access from, Access to) const { gpu::barrier(cmd_, from, to); }

    /// Frees something (a buffer, say) once the GPU has finished these commands and those submitted before.
    template <typename T>
    void release(T object) const {
        assert(released_);
        released_->add(std::move(object));
    }

    /// A stage from here to the end of the returned scope: one name for its debug label, its timer and its
    /// column in the metrics.
    class Scope {
      public:
        Scope(const Commands& commands, const char* name);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        const Commands& commands_;
        bool labelled_;
    };
    [[nodiscard]] Scope stage(const char* name) const { return Scope(*this, name); }

  private:
    const Device& device_;
    const vk::raii::CommandBuffer& cmd_;
    GpuTimers* timers_;   // may be null
    Released* released_;  // may be null
};

/// Command buffers of the frames in flight. Resources that a frame writes from the CPU exist once a slot.
class FrameRing {
  public:
    FrameRing(const Device& device, std::uint32_t frames_in_flight);
    ~FrameRing();

    std::uint32_t size() const { return static_cast<std::uint32_t>(slots_.size()); }
    /// Waits until the GPU is done with the slot's earlier frame, then starts recording. `slot()` is valid
    /// until submit().
    Commands begin();
    std::uint32_t slot() const { return current_; }
    void submit();
    /// Between frames: frees something once the GPU has finished the next frame.
    template <typename T>
    void release(T object) {
        released_.add(std::move(object));
    }
    /// Waits for everything submitted, and frees what was released.
    void wait();
    /// Stage times of the newest frame that the GPU has finished in this slot.
    const std::vector<StageTime>& stage_times() const { return stage_times_; }

  private:
    struct Slot {
        vk::raii::CommandPool pool = nullptr;
        vk::raii::CommandBuffer cmd = nullptr;
        vk::raii::Fence fence = nullptr;
        GpuTimers timers;
        Released released;  // in its frame or before it
        bool in_flight = false;
    };
    void retire(Slot& slot);

    const Device& device_;
    std::vector<Slot> slots_;
    std::uint32_t current_ = 0;
    std::uint64_t frame_ = 0;
    Released released_;  // since the last submit()
    bool recording_ = false;
    std::vector<StageTime> stage_times_;
};

/// Records, submits and waits: for set-up work outside the frame loop, on any thread.
void submit_and_wait(const Device& device, const std::function<void(const Commands&)>& record);

/// Bytes that set-up work may handle in one submission. What goes on beside frames takes small portions, so
/// that a frame never waits long for its turn on the GPU.
constexpr vk::DeviceSize whole_portion = 256ull << 20, small_portion = 8ull << 20;

/// Copies CPU data into device-local buffers and images through staging memory, in few submissions.
class Uploader {
  public:
    /// `portion`: bytes a submission, but for what is larger itself.
    explicit Uploader(const Device& device, vk::DeviceSize portion = whole_portion)
        : device_(device), portion_(portion) {}
    /// Flushes, but not while a fault unwinds: what was to be filled may be gone already.
    ~Uploader() {
        if (std::uncaught_exceptions() == faults_) flush();
    }
    Uploader(const Uploader&) = delete;
    Uploader& operator=(const Uploader&) = delete;

    Buffer buffer(const std::string& name, std::span<const std::byte> data, vk::BufferUsageFlags extra = {});
    /// Fills the first `levels` levels with tightly packed texels, level after level, makes the others by
    /// halving (linear blit), and leaves the image ready to be sampled by ray tracing and compute shaders.
    Image image(const std::string& name, const ImageInfo& info, std::span<const std::byte> texels,
                std::uint32_t levels = 1);
    /// Everything asked for so far is on the GPU afterwards.
    void flush();

  private:
    int faults_ = std::uncaught_exceptions();  // that unwind already
    void flush_if_large();

    const Device& device_;
    vk::DeviceSize portion_;
    std::vector<Buffer> staging_;
    vk::DeviceSize staged_ = 0;
    std::vector<std::function<void(const Commands&)>> work_;
};

}  // namespace foveray::gpu
