#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/view.h"
#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {

using Rgb = std::array<int, 3>;

inline Rgb pixel(const Image& image, std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* p = image.at(x, y);
    return {p[0], p[1], p[2]};
}

void expect_near(Rgb actual, Rgb expected, const std::string& where, int tolerance = 1);
void expect_uniform(const Image& image, Rgb expected, int tolerance = 0);
/// An sRGB byte for linear light.
int srgb_byte(float linear);
float linear_of(int srgb_byte);

/// A client on the ci headset in stereo, where each eye is shown 256 x 256 pixels over tangents from -1 to 1,
/// and what the simulator captures of it. The head is at the origin of the local space unless the script
/// moves it.
class Composed : public testing::Test {
  protected:
    void start(const std::map<std::string, std::string>& variables = {},
               XrViewConfigurationType type = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO,
               VulkanEnable enable = VulkanEnable::Second);

    struct Part {
        VkRect2D rect;
        Color color;
        std::uint32_t layer = 0;
    };
    /// A swapchain whose image was released with that content.
    XrSwapchain make_picture(VkExtent2D size, const std::vector<Part>& parts,
                             VkFormat format = VK_FORMAT_R8G8B8A8_SRGB, std::uint32_t layers = 1);
    XrSwapchain make_plain(Color color, VkFormat format = VK_FORMAT_R8G8B8A8_SRGB);
    /// 64 x 64 pixels of 4 x 4 cells; (0, 0) is the top left one.
    XrSwapchain make_cells();
    static Color cell_color(int column, int row);

    template <typename Layer>
    Layer make_layer(XrStructureType type, XrSwapchain swapchain, VkExtent2D size = {64, 64}) {
        Layer layer{};
        layer.type = type;
        layer.space = local();
        layer.pose.orientation.w = 1.0f;
        layer.subImage.swapchain = swapchain;
        layer.subImage.imageRect.extent = {static_cast<std::int32_t>(size.width),
                                           static_cast<std::int32_t>(size.height)};
        return layer;
    }
    /// `size` metres on a side, `distance` ahead.
    XrCompositionLayerQuad make_quad(XrSwapchain swapchain, float size = 1.0f, float distance = 2.0f);
    XrSpace local();

    /// A frame of these layers is shown.
    template <typename... Layers>
    void show(XrEnvironmentBlendMode mode, const Layers&... layers) {
        show_all(mode, {reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layers)...});
    }
    template <typename... Layers>
    void show_opaque(const Layers&... layers) {
        show(XR_ENVIRONMENT_BLEND_MODE_OPAQUE, layers...);
    }
    void show_all(XrEnvironmentBlendMode mode,
                  const std::vector<const XrCompositionLayerBaseHeader*>& layers);

    /// Of the last frame. 0: left.
    Image shown(int eye) const;
    std::filesystem::path captures() const { return folder_.path() / "shown"; }

    /// Each cell's middle, put through `point_at` (part of the picture to a point in local space), is found
    /// in both eyes' pictures with its colour where it is in view, which at least `least` are; beside the
    /// picture all is black.
    template <typename PointAt>
    void expect_cells(PointAt point_at, int least) {
        for (int eye = 0; eye < 2; ++eye) {
            const Image image = shown(eye);
            int found = 0;
            for (int row = -1; row <= 4; ++row) {
                for (int column = -1; column <= 4; ++column) {
                    const bool inside = row >= 0 && row < 4 && column >= 0 && column < 4;
                    // Cells are a quarter of the picture; outside, just beyond its edge.
                    const auto part = [](int cell) {
                        return cell < 0 ? -0.03f : cell > 3 ? 1.03f : (static_cast<float>(cell) + 0.5f) / 4;
                    };
                    const vec3 point = point_at(vec2(part(column), part(row)));
                    const auto place = place_of(eye, point);
                    if (!place) continue;
                    found += inside;
                    const Color c = cell_color(column, row);
                    expect_near(pixel(image, place->x, place->y),
                                inside ? Rgb{c[0], c[1], c[2]} : Rgb{0, 0, 0},
                                "eye " + std::to_string(eye) + " cell " + std::to_string(column) + " " +
                                    std::to_string(row));
                }
            }
            EXPECT_GE(found, least);
        }
    }
    /// The pixel of a point in local space; nothing outside the picture.
    static std::optional<uvec2> place_of(int eye, vec3 point);

    fakes::TemporaryFolder folder_;
    std::unique_ptr<SimulatorClient> client_;
    XrViewConfigurationType type_ = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    XrSpace local_ = XR_NULL_HANDLE;
    std::uint64_t frames_ = 0;
};

}  // namespace foveray::simulator_tests
