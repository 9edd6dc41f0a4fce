#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "render/gpu/commands.h"

namespace foveray::fakes {

/// Base of every test that needs Vulkan: one device a process, with the validation layer and its
/// synchronisation checks. A machine without a usable device fails the test. A validation message fails it
/// too.
class GpuTest : public testing::Test {
  protected:
    static gpu::Device& device() {
        static gpu::Device shared({.validation = true});
        return shared;
    }

    /// The first `count` elements of a buffer on the GPU. Waits.
    template <typename T>
    static std::vector<T> read_back(const gpu::Buffer& buffer, std::size_t count) {
        gpu::Buffer target(device(), "read back", buffer.size(), gpu::Residence::Readback);
        gpu::submit_and_wait(device(), [&](const gpu::Commands& cmd) {
            cmd.barrier(gpu::Access::RayTracingWrite, gpu::Access::TransferRead);
            cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::TransferRead);
            cmd.barrier(gpu::Access::TransferWrite, gpu::Access::TransferRead);
            cmd->copyBuffer(buffer.vk(), target.vk(), vk::BufferCopy(0, 0, buffer.size()));
            cmd.barrier(gpu::Access::TransferWrite, gpu::Access::HostRead);
        });
        target.invalidate();
        const auto data = target.mapped_as<T>().subspan(0, count);
        return {data.begin(), data.end()};
    }

    void TearDown() override {
        const auto& messages = device().validation_messages();
        for (; reported_ < messages.size(); ++reported_) ADD_FAILURE() << messages[reported_];
    }

  private:
    static inline std::size_t reported_ = 0;  // messages so far
};

}  // namespace foveray::fakes
