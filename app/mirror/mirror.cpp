#include "app/mirror/mirror.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>

namespace foveray::app {
namespace {

using Layout = vk::ImageLayout;
using gpu::Access;

const Mirror::Picture* find(std::span<const Mirror::Picture> pictures, int eye, ViewRole role) {
    for (const Mirror::Picture& picture : pictures) {
        if (static_cast<int>(picture.view.eye) == eye && picture.view.role == role) return &picture;
    }
    return nullptr;
}

void handle_keys(const std::vector<int>& keys, MirrorState& state) {
    for (const int key : keys) {
        if (key == GLFW_KEY_ESCAPE) state.wants_close = true;
        if (key == GLFW_KEY_TAB) state.show_panel = !state.show_panel;
        if (key == GLFW_KEY_E) state.eye = 1 - state.eye;
        if (key == GLFW_KEY_G) state.show_mark = !state.show_mark;
    }
}

void draw_mark(vec2 at, bool valid) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 centre(at.x, at.y);
    const float strength = valid ? 1.0f : 0.4f;
    list.AddCircle(centre, 17.0f, ImColor(0.0f, 0.0f, 0.0f, 0.6f * strength), 48, 5.0f);
    list.AddCircle(centre, 17.0f, ImColor(1.0f, 1.0f, 1.0f, strength), 48, 2.0f);
    list.AddCircleFilled(centre, 2.5f, ImColor(1.0f, 1.0f, 1.0f, strength));
}

}  // namespace

Mirror::Mirror(const gpu::Device& device, DesktopWindow& window)
    : device_(device), window_(window), swapchain_(device, window) {
    pool_ = {device.vk(), vk::CommandPoolCreateInfo({}, device.queue_family())};
    cmd_ = std::move(vk::raii::CommandBuffers(
        device.vk(), vk::CommandBufferAllocateInfo(*pool_, vk::CommandBufferLevel::ePrimary, 1))[0]);
    done_ = {device.vk(), vk::FenceCreateInfo(vk::FenceCreateFlagBits::eSignaled)};
    const vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, 8);
    descriptors_ = {device.vk(), vk::DescriptorPoolCreateInfo(
                                     vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 8, size)};
    device.set_name(*pool_, "mirror");
    device.set_name(*cmd_, "mirror");
    device.set_name(*done_, "mirror done");
    device.set_name(*descriptors_, "mirror");
    init_imgui();
}

Mirror::~Mirror() {
    {
        const auto lock = device_.lock_queue();
        device_.vk().waitIdle();
    }
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Mirror::init_imgui() {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowBorderSize = 0.0f;
    style.FrameRounding = 4.0f;
    style.GrabRounding = 4.0f;
    style.WindowPadding = {14, 12};
    ImGui_ImplGlfw_InitForVulkan(window_.get(), true);

    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = *device_.instance();
    info.PhysicalDevice = *device_.physical();
    info.Device = *device_.vk();
    info.QueueFamily = device_.queue_family();
    info.Queue = *device_.queue();
    info.DescriptorPool = *descriptors_;
    info.MinImageCount = 2;
    info.ImageCount = std::max(2u, swapchain_.image_count());
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = [](VkResult result) {
        if (result < 0) throw vk::SystemError(vk::make_error_code(vk::Result(result)), "Dear ImGui");
    };
    ImGui_ImplVulkan_Init(&info, swapchain_.render_pass());
#if IMGUI_VERSION_NUM < 19000  // later ones upload their font by themselves
    gpu::submit_and_wait(device_,
                         [](const gpu::Commands& cmd) { ImGui_ImplVulkan_CreateFontsTexture(*cmd.vk()); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
}

void Mirror::show(std::span<const Picture> pictures, const FrameMetrics& metrics, bool has_eye_tracking,
                  Settings& settings) {
    const std::vector<int> keys = window_.poll_events();
    if (!ImGui::GetIO().WantTextInput) handle_keys(keys, state_);
    history_.add(metrics);
    [[maybe_unused]] const vk::Result waited = device_.vk().waitForFences(*done_, VK_TRUE, UINT64_MAX);
    const auto target = swapchain_.acquire();
    if (!target) return;

    const Rect place =
        draw_interface(find(pictures, state_.eye, ViewRole::Context), metrics, has_eye_tracking, settings);

    device_.vk().resetFences(*done_);
    pool_.reset();
    cmd_.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    record(gpu::Commands(device_, cmd_, nullptr), pictures, *target, place);
    cmd_.end();
    const vk::PipelineStageFlags wait = vk::PipelineStageFlagBits::eTransfer;
    const vk::CommandBuffer cmd = *cmd_;
    auto lock = device_.lock_queue();
    device_.queue().submit(vk::SubmitInfo(target->acquired, wait, cmd, target->finished), *done_);
    lock.unlock();
    swapchain_.present();
}

Rect Mirror::draw_interface(const Picture* context, const FrameMetrics& metrics, bool has_eye_tracking,
                            Settings& settings) {
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    const ImGuiIO& io = ImGui::GetIO();
    const float width = io.DisplaySize.x - (state_.show_panel ? panel_width : 0.0f);
    const Rect area{{0, 0}, {std::max(64.0f, width), io.DisplaySize.y}};
    const Rect picture = fit(area, context ? aspect_of(context->view.fov) : 1.0f);
    const vec2 mouse(io.MousePos.x, io.MousePos.y);
    if (!io.WantCaptureMouse && picture.contains(mouse)) pointer_ = (mouse - picture.min) / picture.size();

    const GazeSource source = has_eye_tracking ? GazeSource::Eyes
                              : pointer_       ? GazeSource::Mouse
                                               : GazeSource::Nothing;
    if (state_.show_panel) draw_panel(state_, settings, history_, metrics, source);
    if (const auto mark = metrics.gaze_mark[static_cast<std::size_t>(state_.eye)]; mark && state_.show_mark) {
        draw_mark(picture.min + *mark * picture.size(), metrics.gaze_valid || source == GazeSource::Mouse);
    }
    ImGui::Render();
    const vec2 pixels(io.DisplayFramebufferScale.x, io.DisplayFramebufferScale.y);
    return {picture.min * pixels, picture.max * pixels};
}

void Mirror::record(const gpu::Commands& cmd, std::span<const Picture> pictures,
                    const WindowSwapchain::Target& target, const Rect& place) {
    const auto scope = cmd.stage("mirror");
    cmd.barrier(Access::ComputeWrite, Access::TransferRead);
    gpu::transition(cmd.vk(), target.image, Access::TransferWrite, Layout::eUndefined, Access::TransferWrite,
                    Layout::eTransferDstOptimal);
    const vk::ImageSubresourceRange whole(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
    cmd->clearColorImage(target.image, Layout::eTransferDstOptimal,
                         vk::ClearColorValue(0.02f, 0.02f, 0.025f, 1.0f), whole);

    const Picture* const context = find(pictures, state_.eye, ViewRole::Context);
    const Picture* const focus = find(pictures, state_.eye, ViewRole::Focus);
    const auto put = [&](const Picture& picture, PictureCopy& copy, const Rect& where) {
        cmd.barrier(Access::TransferWrite, Access::TransferWrite);
        copy.record(cmd, picture.color, picture.offset, picture.view.size, target.image, target.extent,
                    where);
    };
    if (context) put(*context, copies_[0], place);
    if (context && focus)
        put(*focus, copies_[1], part_of(place, place_within(focus->view.fov, context->view.fov)));

    gpu::transition(cmd.vk(), target.image, Access::TransferWrite, Layout::eTransferDstOptimal,
                    Access::ColorAttachment, Layout::eColorAttachmentOptimal);
    cmd->beginRenderPass(
        vk::RenderPassBeginInfo(swapchain_.render_pass(), target.framebuffer, vk::Rect2D({}, target.extent)),
        vk::SubpassContents::eInline);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), *cmd.vk());
    cmd->endRenderPass();
    cmd.barrier(Access::TransferRead, Access::ComputeWrite);  // the next frame's pictures
}

}  // namespace foveray::app
