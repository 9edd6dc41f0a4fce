// Layers over one another: order, alpha, colour scale and bias. OpenXR 1.0, section 10.6.3.
#include "tests/xr/simulator/composed.h"

namespace foveray::simulator_tests {
namespace {

constexpr auto source_alpha = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
constexpr auto unpremultiplied = XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;

class Blending : public Composed {
  protected:
    /// Fills both eyes' pictures.
    XrCompositionLayerQuad filling(Color color, XrCompositionLayerFlags flags = 0) {
        auto quad = make_quad(make_plain(color), 8.0f, 1.0f);
        quad.layerFlags = flags;
        return quad;
    }
    void expect_shown(Rgb expected) {
        expect_uniform(shown(0), expected, 1);
        expect_uniform(shown(1), expected, 1);
    }
};

TEST_F(Blending, LaterLayersAreInFront) {
    start();
    const auto far = filling({250, 0, 0, 255});
    auto near = make_quad(make_plain({0, 250, 0, 255}), 1.0f, 2.0f);
    show_opaque(far, near);
    EXPECT_EQ(pixel(shown(0), 128, 128), (Rgb{0, 250, 0}));
    EXPECT_EQ(pixel(shown(0), 20, 128), (Rgb{250, 0, 0}));
    show_opaque(near, far);
    expect_shown({250, 0, 0});
}

TEST_F(Blending, AlphaCountsOnlyWhereTheFlagSaysSo) {
    start();
    const auto behind = filling({100, 200, 50, 255});
    const float a = 64.0f / 255;
    const auto over = [&](float front, int back) { return srgb_byte(front + (1 - a) * linear_of(back)); };
    const Color color{90, 30, 10, 64};
    for (const XrCompositionLayerFlags flags :
         {XrCompositionLayerFlags{0}, XrCompositionLayerFlags{unpremultiplied}}) {
        show_opaque(behind, filling(color, flags));
        expect_shown({90, 30, 10});
    }
    show_opaque(behind, filling(color, source_alpha));
    expect_shown({over(linear_of(90), 100), over(linear_of(30), 200), over(linear_of(10), 50)});
    show_opaque(behind, filling(color, source_alpha | unpremultiplied));
    expect_shown({over(a * linear_of(90), 100), over(a * linear_of(30), 200), over(a * linear_of(10), 50)});
}

TEST_F(Blending, SixteenLayersAddUp) {
    start();
    const auto thin = filling({20, 20, 20, 25}, source_alpha);
    std::vector<const XrCompositionLayerBaseHeader*> layers(
        16, reinterpret_cast<const XrCompositionLayerBaseHeader*>(&thin));
    show_all(XR_ENVIRONMENT_BLEND_MODE_OPAQUE, layers);
    float light = 0.0f;
    for (int i = 0; i < 16; ++i) light = linear_of(20) + (1 - 25.0f / 255) * light;
    expect_shown({srgb_byte(light), srgb_byte(light), srgb_byte(light)});
}

TEST_F(Blending, ColorScaleAndBiasActOnColourWithoutItsAlpha) {
    start();
    XrCompositionLayerColorScaleBiasKHR change{XR_TYPE_COMPOSITION_LAYER_COLOR_SCALE_BIAS_KHR,
                                               nullptr,
                                               {0.5f, 2.0f, -1.0f, 1.0f},
                                               {0.1f, 0.0f, 0.3f, 0.0f}};
    auto layer = filling({200, 100, 250, 255});
    layer.next = &change;
    show_opaque(layer);
    const Rgb changed{srgb_byte(0.5f * linear_of(200) + 0.1f), srgb_byte(2 * linear_of(100)),
                      srgb_byte(0.3f)};
    expect_shown(changed);

    // Scaled alpha makes an opaque layer see-through.
    change.colorScale = {1, 1, 1, 0.25f};
    change.colorBias = {0, 0, 0, 0.25f};
    const auto behind = filling({0, 150, 0, 255});
    show_opaque(behind, layer);
    const auto half = [](int front, int back) {
        return srgb_byte(0.5f * linear_of(front) + 0.5f * linear_of(back));
    };
    expect_shown({half(200, 0), half(100, 150), half(250, 0)});

    // Premultiplied colour is divided by its alpha before, and multiplied with the new one after.
    auto premultiplied = filling({60, 80, 100, 128}, source_alpha);
    premultiplied.next = &change;
    change.colorScale = {0.5f, 0.5f, 0.5f, 0.5f};
    change.colorBias = {};
    show_opaque(behind, premultiplied);
    const auto quarter = [](int front, int back) {
        return srgb_byte(0.25f * linear_of(front) + (1 - 64.0f / 255) * linear_of(back));
    };
    expect_shown({quarter(60, 0), quarter(80, 150), quarter(100, 0)});
}

TEST_F(Blending, ScaleAndBiasWaitForTheirExtension) {
    set_environment({{"CAPTURE", captures()}});
    client_ = std::make_unique<SimulatorClient>();
    client_->create_session();
    client_->begin_session(type_);
    const XrCompositionLayerColorScaleBiasKHR change{
        XR_TYPE_COMPOSITION_LAYER_COLOR_SCALE_BIAS_KHR, nullptr, {0, 0, 0, 0}, {1, 1, 1, 1}};
    auto layer = filling({10, 20, 30, 255});
    layer.next = &change;
    show_opaque(layer);
    expect_shown({10, 20, 30});
}

}  // namespace
}  // namespace foveray::simulator_tests
