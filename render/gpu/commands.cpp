#include "render/gpu/commands.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace foveray::gpu {
namespace {

vk::raii::CommandPool make_pool(const Device& device, const std::string& name) {
    vk::raii::CommandPool pool(device.vk(),
                               {vk::CommandPoolCreateFlagBits::eTransient, device.queue_family()});
    device.set_name(*pool, name);
    return pool;
}

vk::raii::CommandBuffer make_command_buffer(const Device& device, const vk::raii::CommandPool& pool,
                                            const std::string& name) {
    auto buffers = vk::raii::CommandBuffers(device.vk(), {*pool, vk::CommandBufferLevel::ePrimary, 1});
    device.set_name(*buffers.front(), name);
    return std::move(buffers.front());
}

void wait_for(const Device& device, const vk::raii::Fence& fence) {
    const auto result = device.vk().waitForFences(*fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
    assert(result == vk::Result::eSuccess);
    static_cast<void>(result);
}

// Three a pass of --reference, of which there may be 1024, and the others.
constexpr std::uint32_t most_stages = 3 * 1024 + 64;

}  // namespace

Commands::Scope::Scope(const Commands& commands, const char* name)
    : commands_(commands), labelled_(commands.cmd_.getDispatcher()->vkCmdBeginDebugUtilsLabelEXT != nullptr) {
    if (labelled_) commands_.cmd_.beginDebugUtilsLabelEXT({name});
    if (commands_.timers_) commands_.timers_->begin(commands_.cmd_, name);
}

Commands::Scope::~Scope() {
    if (commands_.timers_) commands_.timers_->end(commands_.cmd_);
    if (labelled_) commands_.cmd_.endDebugUtilsLabelEXT();
}

FrameRing::FrameRing(const Device& device, std::uint32_t frames_in_flight) : device_(device) {
    for (std::uint32_t i = 0; i < frames_in_flight; ++i) {
        Slot slot;
        slot.pool = make_pool(device, "frame pool " + std::to_string(i));
        slot.cmd = make_command_buffer(device, slot.pool, "frame " + std::to_string(i));
        slot.fence = vk::raii::Fence(device.vk(), vk::FenceCreateInfo{});
        device.set_name(*slot.fence, "frame fence " + std::to_string(i));
        slot.timers = GpuTimers(device, most_stages);
        slots_.push_back(std::move(slot));
    }
}

FrameRing::~FrameRing() { wait(); }

void FrameRing::retire(Slot& slot) {
    if (!slot.in_flight) return;
    wait_for(device_, slot.fence);
    device_.vk().resetFences(*slot.fence);
    slot.in_flight = false;
    slot.released.free();
    stage_times_ = slot.timers.read();
}

Commands FrameRing::begin() {
    current_ = static_cast<std::uint32_t>(frame_++ % slots_.size());
    Slot& slot = slots_[current_];
    retire(slot);
    slot.pool.reset();
    slot.timers.reset();
    slot.cmd.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    recording_ = true;
    return Commands(device_, slot.cmd, &slot.timers, &released_);
}

void FrameRing::submit() {
    Slot& slot = slots_[current_];
    slot.cmd.end();
    const vk::CommandBufferSubmitInfo command(*slot.cmd);
    device_.submit(vk::SubmitInfo2({}, {}, command), *slot.fence);
    slot.in_flight = true;
    slot.released = std::exchange(released_, {});
    recording_ = false;
}

void FrameRing::wait() {
    for (std::size_t i = 0; i < slots_.size(); ++i) retire(slots_[(frame_ + i) % slots_.size()]);
    if (!recording_) released_.free();
}

void submit_and_wait(const Device& device, const std::function<void(const Commands&)>& record) {
    const vk::raii::CommandPool pool = make_pool(device, "set-up pool");
    const vk::raii::CommandBuffer cmd = make_command_buffer(device, pool, "set-up");
    cmd.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    Released released;
    record(Commands(device, cmd, nullptr, &released));
    cmd.end();
    const vk::raii::Fence fence(device.vk(), vk::FenceCreateInfo{});
    const vk::CommandBufferSubmitInfo command(*cmd);
    device.submit(vk::SubmitInfo2({}, {}, command), *fence);
    wait_for(device, fence);
}

Buffer Uploader::buffer(const std::string& name, std::span<const std::byte> data,
                        vk::BufferUsageFlags extra) {
    Buffer target(device_, name, data.size(), Residence::Device, extra);
    if (data.empty()) return target;
    Buffer source(device_, "staging for " + name, data.size(), Residence::Upload);
    source.write(data);
    work_.push_back([from = source.vk(), to = target.vk(), size = data.size()](const Commands& cmd) {
        cmd->copyBuffer(from, to, vk::BufferCopy(0, 0, size));
    });
    staged_ += data.size();
    staging_.push_back(std::move(source));
    flush_if_large();
    return target;
}

Image Uploader::image(const std::string& name, const ImageInfo& info, std::span<const std::byte> texels,
                      std::uint32_t levels) {
    assert(levels >= 1 && levels <= info.mip_levels);
    ImageInfo full = info;
    full.usage |= vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eTransferDst;
    Image target(device_, name, full);
    Buffer source(device_, "staging for " + name, texels.size(), Residence::Upload);
    source.write(texels);
    work_.push_back([from = source.vk(), to = target.vk(), full, levels,
                     bytes = texels.size()](const Commands& cmd) {
        using Layout = vk::ImageLayout;
        constexpr auto colour = vk::ImageAspectFlagBits::eColor;
        transition(cmd.vk(), to, Access::None, Layout::eUndefined, Access::TransferWrite,
                   Layout::eTransferDstOptimal);
        std::vector<vk::BufferImageCopy> copies;
        vk::DeviceSize start = 0;  // texels before the level
        vk::Extent3D extent(full.extent, 1);
        for (std::uint32_t level = 0; level < levels; ++level) {
            copies.emplace_back(start, 0, 0, vk::ImageSubresourceLayers(colour, level, 0, 1), vk::Offset3D(),
                                extent);
            start += vk::DeviceSize{extent.width} * extent.height;
            extent = vk::Extent3D(std::max(1u, extent.width / 2), std::max(1u, extent.height / 2), 1);
        }
        for (vk::BufferImageCopy& copy : copies) copy.bufferOffset *= bytes / start;  // of one texel
        cmd->copyBufferToImage(from, to, Layout::eTransferDstOptimal, copies);
        const auto size_of = [&](std::uint32_t level) {
            return vk::Offset3D(static_cast<int>(std::max(1u, full.extent.width >> level)),
                                static_cast<int>(std::max(1u, full.extent.height >> level)), 1);
        };
        for (std::uint32_t level = levels; level < full.mip_levels; ++level) {
            transition(cmd.vk(), to, Access::TransferWrite, Layout::eTransferDstOptimal, Access::TransferRead,
                       Layout::eTransferSrcOptimal, colour, level - 1, 1);
            cmd->blitImage(to, Layout::eTransferSrcOptimal, to, Layout::eTransferDstOptimal,
                           vk::ImageBlit({colour, level - 1, 0, 1}, {vk::Offset3D(), size_of(level - 1)},
                                         {colour, level, 0, 1}, {vk::Offset3D(), size_of(level)}),
                           vk::Filter::eLinear);
        }
        const auto finish = [&](Access from_access, Layout layout, std::uint32_t base, std::uint32_t count) {
            if (count == 0) return;
            transition(cmd.vk(), to, from_access, layout, Access::RayTracingRead,
                       Layout::eShaderReadOnlyOptimal, colour, base, count);
        };
        finish(Access::TransferWrite, Layout::eTransferDstOptimal, 0, levels - 1);
        finish(Access::TransferRead, Layout::eTransferSrcOptimal, levels - 1, full.mip_levels - levels);
        finish(Access::TransferWrite, Layout::eTransferDstOptimal, full.mip_levels - 1, 1);
    });
    staged_ += texels.size();
    staging_.push_back(std::move(source));
    flush_if_large();
    return target;
}

void Uploader::flush_if_large() {
    if (staged_ > portion_) flush();
}

void Uploader::flush() {
    if (work_.empty()) return;
    submit_and_wait(device_, [&](const Commands& cmd) {
        for (const auto& step : work_) step(cmd);
        cmd.barrier(Access::TransferWrite, Access::RayTracingRead);
        cmd.barrier(Access::TransferWrite, Access::ComputeRead);
        cmd.barrier(Access::TransferWrite, Access::AccelerationBuildInput);
    });
    work_.clear();
    staging_.clear();
    staged_ = 0;
}

}  // namespace foveray::gpu
