#include "tests/xr/simulator/composed.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace foveray::simulator_tests {

void expect_near(Rgb actual, Rgb expected, const std::string& where, int tolerance) {
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(actual[c], expected[c], tolerance) << where << " channel " << c;
}

void expect_uniform(const Image& image, Rgb expected, int tolerance) {
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            expect_near(pixel(image, x, y), expected, std::to_string(x) + " " + std::to_string(y), tolerance);
            if (testing::Test::HasFailure()) return;
        }
    }
}

int srgb_byte(float linear) {
    return static_cast<int>(std::lround(255.0f * srgb_from_linear(std::clamp(linear, 0.0f, 1.0f))));
}
float linear_of(int byte) { return linear_from_srgb(static_cast<float>(byte) / 255.0f); }

void Composed::start(const std::map<std::string, std::string>& variables, XrViewConfigurationType type,
                     VulkanEnable enable) {
    auto all = variables;
    all.try_emplace("CAPTURE", captures());
    set_environment(all);
    auto extensions = all_extensions;
    extensions.push_back(enable == VulkanEnable::First
                             ? XR_KHR_VULKAN_ENABLE_EXTENSION_NAME
                             : XR_KHR_COMPOSITION_LAYER_COLOR_SCALE_BIAS_EXTENSION_NAME);
    client_ = std::make_unique<SimulatorClient>(extensions);
    client_->create_session(enable);
    client_->begin_session(type);
    type_ = type;
}

XrSpace Composed::local() {
    if (!local_) local_ = client_->reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
    return local_;
}

XrSwapchain Composed::make_picture(VkExtent2D size, const std::vector<Part>& parts, VkFormat format,
                                   std::uint32_t layers) {
    XrSwapchainCreateInfo info{};
    info.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
    info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
    info.format = format;
    info.sampleCount = info.faceCount = info.mipCount = 1;
    info.arraySize = layers;
    info.width = size.width;
    info.height = size.height;
    XrSwapchain swapchain = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateSwapchain(client_->session, &info, &swapchain), XR_SUCCESS);
    std::uint32_t index = 0, count = 0;
    EXPECT_EQ(xrAcquireSwapchainImage(swapchain, nullptr, &index), XR_SUCCESS);
    const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
    EXPECT_EQ(xrWaitSwapchainImage(swapchain, &wait), XR_SUCCESS);
    std::vector<XrSwapchainImageVulkanKHR> images(
        3, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR, nullptr, VK_NULL_HANDLE});
    EXPECT_EQ(xrEnumerateSwapchainImages(swapchain, 3, &count,
                                         reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
              XR_SUCCESS);
    for (const Part& part : parts)
        client_->vulkan->fill(images[index].image, part.layer, part.rect, part.color);
    EXPECT_EQ(xrReleaseSwapchainImage(swapchain, nullptr), XR_SUCCESS);
    return swapchain;
}

XrSwapchain Composed::make_plain(Color color, VkFormat format) {
    return make_picture({64, 64}, {{{{0, 0}, {64, 64}}, color}}, format);
}

Color Composed::cell_color(int column, int row) {
    return {static_cast<std::uint8_t>(60 + 60 * column), static_cast<std::uint8_t>(60 + 60 * row), 120, 255};
}

XrSwapchain Composed::make_cells() {
    std::vector<Part> parts;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column)
            parts.push_back({{{16 * column, 16 * row}, {16, 16}}, cell_color(column, row)});
    }
    return make_picture({64, 64}, parts);
}

XrCompositionLayerQuad Composed::make_quad(XrSwapchain swapchain, float size, float distance) {
    auto quad = make_layer<XrCompositionLayerQuad>(XR_TYPE_COMPOSITION_LAYER_QUAD, swapchain);
    quad.size = {size, size};
    quad.pose.position.z = -distance;
    return quad;
}

void Composed::show_all(XrEnvironmentBlendMode mode,
                        const std::vector<const XrCompositionLayerBaseHeader*>& layers) {
    const XrFrameState state = client_->wait_frame();
    EXPECT_EQ(xrBeginFrame(client_->session, nullptr), XR_SUCCESS);
    EXPECT_EQ(client_->end_frame(state.predictedDisplayTime, layers, mode), XR_SUCCESS);
    ++frames_;
}

Image Composed::shown(int eye) const {
    char name[40];
    std::snprintf(name, sizeof name, "frame_%05d_%s.png", static_cast<int>(frames_ - 1),
                  eye ? "right" : "left");
    return read_image(captures() / name, 3);
}

std::optional<uvec2> Composed::place_of(int eye, vec3 point) {
    point.x -= eye ? 0.0315f : -0.0315f;
    if (point.z >= 0.0f) return {};
    const vec2 part = vec2(0.5f) + vec2(0.5f, -0.5f) * vec2(point) / -point.z;
    if (part.x <= 0.0f || part.y <= 0.0f || part.x >= 1.0f || part.y >= 1.0f) return {};
    return uvec2(part * 256.0f);
}

}  // namespace foveray::simulator_tests
