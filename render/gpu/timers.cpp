#include "render/gpu/timers.h"

#include <algorithm>
#include <cassert>

namespace foveray::gpu {

std::uint64_t elapsed_ticks(std::uint64_t begin, std::uint64_t end, std::uint32_t valid_bits) {
    const std::uint64_t mask = valid_bits < 64 ? (std::uint64_t{1} << valid_bits) - 1 : ~std::uint64_t{0};
    return (end - begin) & mask;
}

GpuTimers::GpuTimers(const Device& device, std::uint32_t max_stages)
    : device_(&device),
      pool_(device.vk(), {{}, vk::QueryType::eTimestamp, 2 * max_stages}),
      capacity_(2 * max_stages) {
    device.set_name(*pool_, "stage timers");
    pool_.reset(0, capacity_);
}

void GpuTimers::reset() {
    if (capacity_ > 0) pool_.reset(0, capacity_);
    used_ = 0;
    stages_.clear();
    open_.clear();
}

void GpuTimers::begin(const vk::raii::CommandBuffer& cmd, const char* name) {
    assert(used_ + 2 <= capacity_);
    open_.push_back(stages_.size());
    stages_.push_back({name, used_, used_ + 1});
    cmd.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pool_, used_);
    used_ += 2;
}

void GpuTimers::end(const vk::raii::CommandBuffer& cmd) {
    cmd.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pool_, stages_[open_.back()].end);
    open_.pop_back();
}

std::vector<StageTime> GpuTimers::read() const {
    std::vector<StageTime> times;
    if (used_ == 0) return times;
    const auto [result, stamps] = pool_.getResults<std::uint64_t>(
        0, used_, used_ * sizeof(std::uint64_t), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
    if (result != vk::Result::eSuccess) return times;
    for (const Stage& stage : stages_) {
        const std::uint64_t ticks =
            elapsed_ticks(stamps[stage.begin], stamps[stage.end], device_->timestamp_valid_bits());
        const double ms = static_cast<double>(ticks) * device_->timestamp_period_ns() * 1e-6;
        const auto it =
            std::find_if(times.begin(), times.end(), [&](const auto& t) { return t.name == stage.name; });
        if (it == times.end()) {
            times.push_back({stage.name, ms});
        } else {
            it->milliseconds += ms;
        }
    }
    return times;
}

}  // namespace foveray::gpu
