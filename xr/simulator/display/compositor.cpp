#include "xr/simulator/display/compositor.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <tuple>

#include "xr/simulator/api/verify.h"

namespace foveray::simulator {
namespace {

using Eyes = std::array<EyeDisplay, 2>;

VkDeviceSize pixels_of(const EyeDisplay& eye) { return VkDeviceSize{eye.size.x} * eye.size.y; }

VkMemoryBarrier memory_barrier(VkAccessFlags written, VkAccessFlags next) {
    return {VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, written, next};
}

/// An image layer that composition reads.
using ImageLayer = std::pair<VkImage, std::uint32_t>;

VkImageMemoryBarrier layout_barrier(ImageLayer layer, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = layer.first;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, layer.second, 1};
    return barrier;
}

}  // namespace

struct Compositor::Dispatches {
    std::vector<LayerDraw> layers[2];  // by eye
    std::set<ImageLayer> images;       // each once, for the barriers
    std::vector<shared::CompositionDraw> draws;

    void add(const SubImage& image) {
        images.emplace(image.swapchain->image(image.image), image.array_index);
    }
};

Compositor::Compositor(VulkanDevice& device, const Background& background)
    : device_(device), background_(device, background), pipelines_(device) {
    const auto& f = device.functions();
    if (device.timestamp_bits() > 0) {
        const VkQueryPoolCreateInfo info{
            VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, nullptr, 0, VK_QUERY_TYPE_TIMESTAMP, 2, 0};
        VkQueryPool queries = VK_NULL_HANDLE;
        verify_vulkan(f.vkCreateQueryPool(device.handle(), &info, nullptr, &queries), "vkCreateQueryPool");
        queries_ =
            device.own(queries, f.vkDestroyQueryPool, VK_OBJECT_TYPE_QUERY_POOL, "simulator timestamps");
    }
    batch_ = device.create_batch("simulator composition");
    draws_ = device.create_buffer(ComputePipelines::max_dispatches * sizeof(shared::CompositionDraw),
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, VulkanDevice::Place::Upload,
                                  "simulator draws");
}

void Compositor::make_buffers(const Eyes& eyes) {
    using Place = VulkanDevice::Place;
    constexpr auto storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    if (light_[0].size == 8 * pixels_of(eyes[0]) && light_[1].size == 8 * pixels_of(eyes[1])) return;
    for (std::size_t eye = 0; eye < 2; ++eye) {
        light_[eye] =
            device_.create_buffer(8 * pixels_of(eyes[eye]), storage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                  Place::Gpu, "simulator light");
    }
    const VkDeviceSize bytes = 4 * (pixels_of(eyes[0]) + pixels_of(eyes[1]));
    bytes_ = device_.create_buffer(bytes, storage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Place::Gpu,
                                   "simulator pictures");
    readback_ =
        device_.create_buffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, Place::Readback, "simulator readback");
}

Compositor::Dispatches Compositor::gather(const SubmittedFrame& frame, const Eyes& eyes) {
    Dispatches dispatches;
    for (std::size_t eye = 0; eye < 2; ++eye) {
        dispatches.layers[eye] = draw_layers(frame, eyes[eye]);
        for (const LayerDraw& layer : dispatches.layers[eye]) {
            dispatches.draws.push_back(layer.draw);
            dispatches.add(*layer.source);
            if (layer.focus) dispatches.add(*layer.focus);
        }
    }
    const Background& background = background_.background();
    for (const EyeDisplay& eye : eyes) {
        shared::CompositionDraw& draw = dispatches.draws.emplace_back(draw_background(frame, eye));
        draw.what.x = background.kind == Background::Kind::Environment ? shared::COMPOSITION_ENVIRONMENT
                      : background.kind == Background::Kind::Sequence  ? shared::COMPOSITION_PICTURE
                                                                       : shared::COMPOSITION_COLOR;
        draw.scale = vec4(background.color, 1.0f);
    }
    return dispatches;
}

void Compositor::start(const SubmittedFrame& frame, const Eyes& eyes) {
    make_buffers(eyes);
    background_.prepare(frame.index);
    pipelines_.reset();
    sizes_ = {eyes[0].size, eyes[1].size};
    const Dispatches dispatches = gather(frame, eyes);
    std::memcpy(draws_.mapped, dispatches.draws.data(),
                dispatches.draws.size() * sizeof dispatches.draws.front());
    device_.start(batch_, [&](VkCommandBuffer commands) { record(commands, dispatches, eyes); });
    SubmittedFrame last = frame;
    const std::lock_guard lock(frame_mutex_);
    std::swap(frame_, last);
}

void Compositor::forget() {
    SubmittedFrame last;
    const std::lock_guard lock(frame_mutex_);
    std::swap(frame_, last);
}

EyePictures Compositor::finish() {
    device_.finish(batch_);
    read_timestamps();
    const auto* bytes = static_cast<const std::uint8_t*>(readback_.mapped);
    const auto byte_count = [](uvec2 size) { return std::size_t{4} * size.x * size.y; };
    const std::size_t left = byte_count(sizes_[0]), right = byte_count(sizes_[1]);
    return {EyePicture{sizes_[0], {bytes, left}}, EyePicture{sizes_[1], {bytes + left, right}}};
}

bool Compositor::shows(const Swapchain& swapchain) const {
    const std::lock_guard lock(frame_mutex_);
    const auto is_it = [&](const SubImage& part) { return part.swapchain.get() == &swapchain; };
    return std::ranges::any_of(frame_.layers, [&](const Layer& layer) {
        if (const auto* surface = std::get_if<Surface>(&layer.content)) return is_it(surface->image);
        return std::ranges::any_of(std::get<Projection>(layer.content).views,
                                   [&](const ProjectionView& view) { return is_it(view.image); });
    });
}

std::optional<double> Compositor::gpu_milliseconds() const {
    const double measured = gpu_milliseconds_;
    return measured >= 0.0 ? std::optional(measured) : std::nullopt;
}

void Compositor::record(VkCommandBuffer commands, const Dispatches& dispatches, const Eyes& eyes) {
    const auto& f = device_.functions();
    constexpr auto client = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    constexpr auto sampled = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    constexpr auto compute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, transfer = VK_PIPELINE_STAGE_TRANSFER_BIT,
                   all = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    const auto memory = [&](VkPipelineStageFlags from, VkPipelineStageFlags to,
                            const VkMemoryBarrier& barrier) {
        f.vkCmdPipelineBarrier(commands, from, to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
    };
    std::vector<VkImageMemoryBarrier> to_sampled, back;
    for (const ImageLayer& image : dispatches.images) {
        to_sampled.push_back(layout_barrier(image, client, sampled));
        back.push_back(layout_barrier(image, sampled, client));
    }

    if (*queries_) f.vkCmdResetQueryPool(commands, *queries_, 0, 2);
    const auto image_count = static_cast<std::uint32_t>(to_sampled.size());
    f.vkCmdPipelineBarrier(commands, all, compute, 0, 0, nullptr, 0, nullptr, image_count, to_sampled.data());
    record_timestamp(commands, 0);
    background_.record(commands);
    for (const auto& light : light_) f.vkCmdFillBuffer(commands, *light.buffer, 0, VK_WHOLE_SIZE, 0);
    constexpr auto read_write = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
    memory(transfer, compute, memory_barrier(VK_ACCESS_TRANSFER_WRITE_BIT, read_write));

    // The eyes' pictures are drawn side by side, the layers one after the other.
    ComputePipelines::Bindings bindings;
    bindings.draws = {*draws_.buffer, 0, VK_WHOLE_SIZE};
    bindings.bytes = {*bytes_.buffer, 0, VK_WHOLE_SIZE};
    const auto dispatch = [&](ComputePipelines::Shader shader, std::size_t eye, std::size_t draw) {
        bindings.light = {*light_[eye].buffer, 0, VK_WHOLE_SIZE};
        pipelines_.dispatch(commands, shader, bindings, static_cast<std::uint32_t>(draw), eyes[eye].size.x,
                            eyes[eye].size.y);
    };
    const std::size_t counts[2] = {dispatches.layers[0].size(), dispatches.layers[1].size()};
    for (std::size_t i = 0; i < std::max(counts[0], counts[1]); ++i) {
        for (std::size_t eye = 0; eye < 2; ++eye) {
            if (i >= counts[eye]) continue;
            const LayerDraw& layer = dispatches.layers[eye][i];
            const auto view = [](const SubImage& image) {
                return image.swapchain->view(image.image, image.array_index);
            };
            bindings.source = view(*layer.source);
            bindings.focus = layer.focus ? view(*layer.focus) : background_.view();
            dispatch(ComputePipelines::Shader::Layer, eye, eye * counts[0] + i);
        }
        memory(compute, compute, memory_barrier(VK_ACCESS_SHADER_WRITE_BIT, read_write));
    }
    bindings.source = bindings.focus = background_.view();
    for (std::size_t eye = 0; eye < 2; ++eye)
        dispatch(ComputePipelines::Shader::Display, eye, counts[0] + counts[1] + eye);
    record_timestamp(commands, 1);
    memory(compute, transfer, memory_barrier(VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT));
    const VkBufferCopy whole{0, 0, bytes_.size};
    f.vkCmdCopyBuffer(commands, *bytes_.buffer, *readback_.buffer, 1, &whole);
    memory(transfer, VK_PIPELINE_STAGE_HOST_BIT,
           memory_barrier(VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_HOST_READ_BIT));
    f.vkCmdPipelineBarrier(commands, compute, all, 0, 0, nullptr, 0, nullptr, image_count, back.data());
}

/// After all that the queue was given before.
void Compositor::record_timestamp(VkCommandBuffer commands, std::uint32_t query) {
    if (!*queries_) return;
    device_.functions().vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, *queries_, query);
}

void Compositor::read_timestamps() {
    if (!*queries_) return;
    std::uint64_t ticks[2];
    verify_vulkan(device_.functions().vkGetQueryPoolResults(device_.handle(), *queries_, 0, 2, sizeof ticks,
                                                            ticks, sizeof ticks[0], VK_QUERY_RESULT_64_BIT),
                  "vkGetQueryPoolResults");
    const std::uint32_t bits = device_.timestamp_bits();
    const std::uint64_t mask = bits < 64 ? (std::uint64_t{1} << bits) - 1 : ~std::uint64_t{0};
    gpu_milliseconds_ = static_cast<double>((ticks[1] - ticks[0]) & mask) *
                        static_cast<double>(device_.nanoseconds_per_tick()) * 1e-6;
}

}  // namespace foveray::simulator
