#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "render/gpu/device.h"

namespace foveray::gpu {

struct StageTime {
    std::string name;
    double milliseconds = 0.0;
};

/// Ticks from one timestamp to the next, of which only the lowest `valid_bits` count: they may wrap between.
std::uint64_t elapsed_ticks(std::uint64_t begin, std::uint64_t end, std::uint32_t valid_bits);

/// GPU timestamps round the stages of one command buffer. A name that occurs twice is summed.
class GpuTimers {
  public:
    GpuTimers() = default;
    explicit GpuTimers(const Device& device, std::uint32_t max_stages = 64);

    void reset();  // before recording; no command may still use the queries
    void begin(const vk::raii::CommandBuffer& cmd, const char* name);
    void end(const vk::raii::CommandBuffer& cmd);
    /// In order of first use; call when the GPU has finished the command buffer.
    std::vector<StageTime> read() const;

  private:
    struct Stage {
        std::string name;
        std::uint32_t begin = 0, end = 0;
    };
    const Device* device_ = nullptr;
    vk::raii::QueryPool pool_ = nullptr;
    std::uint32_t capacity_ = 0, used_ = 0;
    std::vector<Stage> stages_;
    std::vector<std::size_t> open_;
};

}  // namespace foveray::gpu
