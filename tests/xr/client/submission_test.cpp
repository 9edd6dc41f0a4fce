// What reaches the runtime at the end of a frame, seen between our client and the loader, and in the pictures
// that the simulated headset shows.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/image.h"
#include "tests/xr/client/headset_fixture.h"
#include "tests/xr/client/loader_spy.h"

namespace foveray::xr {
namespace {

constexpr float near_z = 0.1f, far_z = 50.0f;  // as HeadsetTest::play gives them

/// Depth of pixel `i` of view `view`: every one another.
float depth_of(std::size_t view, std::size_t i) {
    return static_cast<float>(view + 1) * 0.2f + static_cast<float>(i) * 1e-7f;
}

/// Colour of a view: half covered, premultiplied.
std::uint32_t color_of(std::size_t view) {
    return 0x80000000u | (20u * static_cast<std::uint32_t>(view) + 30u);
}

class SubmissionTest : public HeadsetTest {
  protected:
    void SetUp() override {
        HeadsetTest::SetUp();
        loader_spy::take_ended_frames();
    }

    /// Records colours and depths of all views; the caller submits.
    static void record(Headset& headset, const gpu::Device& device, const gpu::Commands& cmd,
                       const Frame& frame, std::vector<gpu::Buffer>& kept) {
        kept.clear();
        std::vector<ViewPicture> pictures;
        for (std::size_t view = 0; view < frame.views.size(); ++view) {
            const std::size_t count = std::size_t{frame.views[view].size.x} * frame.views[view].size.y;
            std::vector<std::uint32_t> color(count, color_of(view));
            std::vector<float> depth(count);
            for (std::size_t i = 0; i < count; ++i) depth[i] = depth_of(view, i);
            kept.emplace_back(device, "colour", 4 * count, gpu::Residence::Upload);
            kept.back().write(gpu::range_bytes(color));
            kept.emplace_back(device, "depth", 4 * count, gpu::Residence::Upload);
            kept.back().write(gpu::range_bytes(depth));
        }
        for (std::size_t view = 0; view < frame.views.size(); ++view)
            pictures.push_back({kept[2 * view].vk(), 0, kept[2 * view + 1].vk(), 0});
        headset.record_submission(cmd, frame, pictures);
    }

    /// What the depth image that the client last filled holds, after the frame was ended.
    static std::vector<float> read_depth(const gpu::Device& device, XrSwapchain swapchain, uvec2 size) {
        std::uint32_t count = 0;
        xrEnumerateSwapchainImages(swapchain, 0, &count, nullptr);
        std::vector<XrSwapchainImageVulkan2KHR> images(count);
        for (auto& image : images) image.type = XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR;
        xrEnumerateSwapchainImages(swapchain, count, &count,
                                   reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data()));
        const vk::Image image(images[loader_spy::last_image(swapchain)].image);
        gpu::Buffer target(device, "depth read back", vk::DeviceSize{4} * size.x * size.y,
                           gpu::Residence::Readback);
        constexpr auto aspect = vk::ImageAspectFlagBits::eDepth;
        constexpr auto attachment = vk::ImageLayout::eDepthStencilAttachmentOptimal;
        constexpr auto readable = vk::ImageLayout::eTransferSrcOptimal;
        gpu::submit_and_wait(device, [&](const gpu::Commands& cmd) {
            gpu::transition(cmd.vk(), image, gpu::Access::DepthAttachment, attachment,
                            gpu::Access::TransferRead, readable, aspect);
            cmd->copyImageToBuffer(image, readable, target.vk(),
                                   vk::BufferImageCopy(0, 0, 0, {aspect, 0, 0, 1}, {}, {size.x, size.y, 1}));
            gpu::transition(cmd.vk(), image, gpu::Access::TransferRead, readable,
                            gpu::Access::DepthAttachment, attachment, aspect);
            cmd.barrier(gpu::Access::TransferWrite, gpu::Access::HostRead);
        });
        target.invalidate();
        const auto values = target.mapped_as<float>();
        return {values.begin(), values.end()};
    }

    static int shown_red(const SimulatorOptions& simulator, const std::string& name) {
        const Image shown = read_image(simulator.capture / name, 3);
        return *shown.at(shown.width / 2, shown.height / 2);
    }
};

TEST_F(SubmissionTest, ShowsWhatWasSubmitted) {
    SimulatorOptions simulator = options();
    simulator.capture = folder_.path() / "shown";
    simulator.capture_frames = {2, 3};
    const Played played = play(simulator, BlendMode::Opaque,
                               [&](Headset& headset, const gpu::Device& device, gpu::FrameRing& ring,
                                   const Frame& frame, std::vector<gpu::Buffer>& kept) {
                                   const gpu::Commands cmd = ring.begin();
                                   record(headset, device, cmd, frame, kept);
                                   ring.submit();
                               });
    EXPECT_TRUE(played.messages.empty()) << played.messages.front();
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::string name = "frame_00002_view" + std::to_string(i) + ".png";
        const Image shown = read_image(simulator.capture / name, 3);
        EXPECT_EQ(uvec2(shown.width, shown.height), played.frames[2].views[i].size);
        EXPECT_EQ(shown_red(simulator, name), 20 * static_cast<int>(i) + 30);
    }
    EXPECT_FALSE(std::filesystem::exists(simulator.capture / "frame_00001_view0.png"));
    EXPECT_TRUE(std::filesystem::exists(simulator.capture / "frame_00002_left.png"));

    const auto ended = loader_spy::take_ended_frames();
    ASSERT_EQ(ended.size(), played.frames.size());
    EXPECT_EQ(ended[2].blend, XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
    ASSERT_EQ(ended[2].layers.size(), 1u);
    EXPECT_EQ(ended[2].layers[0].flags, 0u);
}

TEST_F(SubmissionTest, BlendsPremultipliedColourWithTheWorld) {
    const Played played = play(options(), BlendMode::AlphaBlend,
                               [&](Headset& headset, const gpu::Device& device, gpu::FrameRing& ring,
                                   const Frame& frame, std::vector<gpu::Buffer>& kept) {
                                   EXPECT_EQ(frame.blend, BlendMode::AlphaBlend);
                                   const gpu::Commands cmd = ring.begin();
                                   record(headset, device, cmd, frame, kept);
                                   ring.submit();
                               });
    EXPECT_TRUE(played.messages.empty()) << played.messages.front();
    const auto ended = loader_spy::take_ended_frames();
    ASSERT_EQ(ended.size(), played.frames.size());
    for (std::size_t i = 0; i < ended.size(); ++i) {
        EXPECT_EQ(ended[i].result, XR_SUCCESS);
        EXPECT_EQ(ended[i].display_time, played.frames[i].display_time);
        EXPECT_EQ(ended[i].blend, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
        ASSERT_EQ(ended[i].layers.size(), 1u);
        EXPECT_EQ(ended[i].layers[0].flags, XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT)
            << "source alpha, and nothing that says it is not premultiplied";
        ASSERT_EQ(ended[i].layers[0].views.size(), 4u);
        for (std::size_t view = 0; view < 4; ++view) {
            const auto& submitted = ended[i].layers[0].views[view];
            EXPECT_EQ(to_pose(submitted.pose), played.frames[i].views[view].stage_from_eye);
            EXPECT_EQ(to_fov(submitted.fov), played.frames[i].views[view].fov);
            EXPECT_EQ(submitted.subImage.imageRect.extent.width,
                      static_cast<int>(played.frames[i].views[view].size.x));
        }
    }
}

TEST_F(SubmissionTest, FallsBackToABlendModeThatTheHeadsetHas) {
    SimulatorOptions simulator = options();
    simulator.profile = "valve-index";  // opaque only
    session_.frames = 1;
    options();
    play(simulator, BlendMode::AlphaBlend,
         [](Headset&, const gpu::Device&, gpu::FrameRing&, const Frame& frame, auto&&) {
             EXPECT_EQ(frame.blend, BlendMode::Opaque);
         });
    const auto ended = loader_spy::take_ended_frames();
    ASSERT_EQ(ended.size(), 1u);
    EXPECT_EQ(ended[0].blend, XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
    EXPECT_EQ(ended[0].result, XR_SUCCESS);
}

TEST_F(SubmissionTest, DepthArrivesWithItsRange) {
    session_.frames = 3;
    std::vector<std::vector<float>> found;
    std::vector<std::vector<uvec2>> sizes;
    const gpu::Device* gpu = nullptr;
    const auto read_last = [&] {
        for (const auto& ended : loader_spy::take_ended_frames()) {
            ASSERT_EQ(ended.layers.size(), 1u);
            ASSERT_EQ(ended.layers[0].depths.size(), 4u);
            for (std::size_t view = 0; view < 4; ++view) {
                const auto& depth = ended.layers[0].depths[view];
                const auto& color = ended.layers[0].views[view].subImage;
                EXPECT_EQ(depth.minDepth, 0.0f);
                EXPECT_EQ(depth.maxDepth, 1.0f);
                EXPECT_EQ(depth.nearZ, near_z);
                EXPECT_EQ(depth.farZ, far_z);
                EXPECT_EQ(depth.subImage.imageArrayIndex, 0u);
                const auto& extent = depth.subImage.imageRect.extent;
                EXPECT_EQ(extent.width, color.imageRect.extent.width);
                EXPECT_EQ(extent.height, color.imageRect.extent.height);
                const auto values = read_depth(*gpu, depth.subImage.swapchain, {extent.width, extent.height});
                std::size_t wrong = 0;
                for (std::size_t i = 0; i < values.size(); ++i) wrong += values[i] != depth_of(view, i);
                EXPECT_EQ(wrong, 0u) << "of " << values.size() << " pixels of view " << view;
                found.push_back(values);
            }
        }
    };
    const Played played = play(options(), BlendMode::Opaque,
                               [&](Headset& headset, const gpu::Device& device, gpu::FrameRing& ring,
                                   const Frame& frame, std::vector<gpu::Buffer>& kept) {
                                   gpu = &device;
                                   read_last();  // of the frame before
                                   const gpu::Commands cmd = ring.begin();
                                   record(headset, device, cmd, frame, kept);
                                   ring.submit();
                               });
    EXPECT_EQ(found.size(), 2u * 4u);
    EXPECT_TRUE(played.messages.empty()) << played.messages.front();
}

TEST_F(SubmissionTest, GoesOnAfterAFrameThatTheRuntimeDiscards) {
    SimulatorOptions simulator = options();
    simulator.capture = folder_.path() / "shown";
    Headset headset(RuntimeChoice::Simulator, simulator);
    const gpu::Device device({.validation = true}, headset.device_source());
    const StopAtEnd stop_at_end(headset);
    headset.start(device, BlendMode::Opaque, near_z, far_z);
    std::vector<gpu::Buffer> kept;
    gpu::FrameRing ring(device, 1);
    const auto draw = [&] {
        const Frame frame = headset.begin_frame().value();
        const gpu::Commands cmd = ring.begin();
        record(headset, device, cmd, frame, kept);
        ring.submit();
        return frame;
    };
    ASSERT_EQ(headset.poll(), Headset::State::Running);
    draw();  // begun, submitted to the GPU and never ended
    for (int i = 0; i < 3; ++i) headset.end_frame(draw());
    EXPECT_FALSE(std::filesystem::exists(simulator.capture / "frame_00000_view0.png"));
    EXPECT_EQ(shown_red(simulator, "frame_00001_view0.png"), 30);
    const auto ended = loader_spy::take_ended_frames();
    ASSERT_EQ(ended.size(), 3u);
    for (const auto& frame : ended) EXPECT_EQ(frame.result, XR_SUCCESS);
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
}

TEST_F(SubmissionTest, AnExceptionInsideAFrameStillEndsIt) {
    SimulatorOptions simulator = options();
    simulator.capture = folder_.path() / "shown";
    XrTime display_time = 0;
    EXPECT_THROW(play(simulator, BlendMode::AlphaBlend,
                      [&](Headset& headset, const gpu::Device& device, gpu::FrameRing& ring,
                          const Frame& frame, std::vector<gpu::Buffer>& kept) {
                          const gpu::Commands cmd = ring.begin();
                          record(headset, device, cmd, frame, kept);
                          if (frame.index == 2) {
                              display_time = frame.display_time;
                              throw std::runtime_error("in the middle of a frame");
                          }
                          ring.submit();
                      }),
                 std::runtime_error);
    const auto ended = loader_spy::take_ended_frames();
    ASSERT_EQ(ended.size(), 3u);
    EXPECT_EQ(ended[1].layers.size(), 1u);
    EXPECT_EQ(ended[2].display_time, display_time);
    EXPECT_TRUE(ended[2].layers.empty());
    EXPECT_EQ(ended[2].blend, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
    EXPECT_EQ(ended[2].result, XR_SUCCESS);
    EXPECT_EQ(shown_red(simulator, "frame_00001_left.png"), 70) << "the focus view";
    EXPECT_EQ(shown_red(simulator, "frame_00002_left.png"), 0) << "nothing was shown";
}

}  // namespace
}  // namespace foveray::xr
