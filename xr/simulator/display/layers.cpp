#include "xr/simulator/display/layers.h"

#include <cmath>

#include "xr/simulator/api/limits.h"
#include "xr/simulator/convert.h"
#include "xr/simulator/session.h"
#include "xr/simulator/space.h"

namespace foveray::simulator {
namespace {

// Clients compute 2 pi in single precision.
constexpr float full_turn = 2.0f * pi + 1e-5f;

SubImage read_sub_image(const Session& session, const XrSwapchainSubImage& info) {
    SubImage image{get<Swapchain>(info.swapchain), 0, info.imageRect, info.imageArrayIndex};
    const XrSwapchainCreateInfo& swapchain = image.swapchain->info();
    verify(&image.swapchain->session() == &session);
    const std::optional<std::uint32_t> shown = image.swapchain->shown();
    verify(shown.has_value(), XR_ERROR_LAYER_INVALID);
    image.image = *shown;
    const auto& [offset, extent] = image.rect;
    verify(offset.x >= 0 && offset.y >= 0 && extent.width > 0 && extent.height > 0 &&
               std::int64_t{offset.x} + extent.width <= swapchain.width &&
               std::int64_t{offset.y} + extent.height <= swapchain.height,
           XR_ERROR_SWAPCHAIN_RECT_INVALID);
    verify(image.array_index < swapchain.arraySize && swapchain.faceCount == 1);
    return image;
}

vec4 from_color(const XrColor4f& color) { return {color.r, color.g, color.b, color.a}; }

/// What all layers have.
template <typename Input>
Layer read_base(const Session& session, const Input& layer) {
    constexpr XrCompositionLayerFlags known = XR_COMPOSITION_LAYER_CORRECT_CHROMATIC_ABERRATION_BIT |
                                              XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT |
                                              XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
    verify((layer.layerFlags & ~known) == 0);
    Layer result;
    result.flags = layer.layerFlags;
    result.space = get<Space>(layer.space);
    verify(&result.space->session() == &session);
    if (const auto* color = find_input<XrCompositionLayerColorScaleBiasKHR>(
            layer.next, XR_TYPE_COMPOSITION_LAYER_COLOR_SCALE_BIAS_KHR);
        color && session.instance().has(XR_KHR_COMPOSITION_LAYER_COLOR_SCALE_BIAS_EXTENSION_NAME)) {
        result.color = {from_color(color->colorScale), from_color(color->colorBias)};
    }
    return result;
}

/// What layers with a picture of their own have: quads, cylinders, equirectangular ones.
template <typename Input>
Layer read_surface(const Session& session, const Input& layer, Surface::Kind kind, float radius, vec4 shape) {
    Layer result = read_base(session, layer);
    verify(layer.eyeVisibility >= XR_EYE_VISIBILITY_BOTH && layer.eyeVisibility <= XR_EYE_VISIBILITY_RIGHT);
    verify(is_valid(layer.pose), XR_ERROR_POSE_INVALID);
    SubImage image = read_sub_image(session, layer.subImage);
    verify(!is_depth_format(image.swapchain->format()), XR_ERROR_LAYER_INVALID);
    result.content = Surface{kind, std::move(image), from_xr(layer.pose), layer.eyeVisibility, radius, shape};
    return result;
}

void verify_fov(const XrFovf& fov) {
    for (const float angle : {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown}) {
        verify(std::isfinite(angle) && std::abs(angle) < pi / 2);
    }
    verify(fov.angleLeft != fov.angleRight && fov.angleUp != fov.angleDown);
}

void verify_depth(const Session& session, const XrCompositionLayerDepthInfoKHR& depth) {
    const SubImage image = read_sub_image(session, depth.subImage);
    verify(is_depth_format(image.swapchain->format()));
    verify(depth.minDepth >= 0.0f && depth.minDepth <= depth.maxDepth && depth.maxDepth <= 1.0f);
    verify(depth.nearZ != depth.farZ && depth.nearZ >= 0.0f && depth.farZ >= 0.0f);
}

Layer read_projection(const Session& session, const XrCompositionLayerProjection& layer) {
    Layer result = read_base(session, layer);
    verify(layer.viewCount == session.view_count() && layer.views != nullptr);
    Projection projection;
    for (std::uint32_t i = 0; i < layer.viewCount; ++i) {
        const XrCompositionLayerProjectionView& view = layer.views[i];
        verify_structure(&view, XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
        verify(is_valid(view.pose), XR_ERROR_POSE_INVALID);
        verify_fov(view.fov);
        projection.views.push_back(
            {from_xr(view.pose), from_xr(view.fov), read_sub_image(session, view.subImage)});
        verify(!is_depth_format(projection.views.back().image.swapchain->format()), XR_ERROR_LAYER_INVALID);
        if (const auto* depth = find_input<XrCompositionLayerDepthInfoKHR>(
                view.next, XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
            depth && session.instance().has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME)) {
            verify_depth(session, *depth);
        }
    }
    result.content = std::move(projection);
    return result;
}

Layer read_quad(const Session& session, const XrCompositionLayerQuad& layer) {
    verify(std::isfinite(layer.size.width) && std::isfinite(layer.size.height));
    return read_surface(session, layer, Surface::Kind::Quad, 0.0f,
                        {layer.size.width, layer.size.height, 0.0f, 0.0f});
}

/// Zero and infinity put the surface at infinity.
float read_radius(float radius) {
    verify(radius >= 0.0f);
    return std::isinf(radius) ? 0.0f : radius;
}

Layer read_cylinder(const Session& session, const XrCompositionLayerCylinderKHR& layer) {
    verify(layer.centralAngle >= 0.0f && layer.centralAngle <= full_turn);
    verify(std::isfinite(layer.aspectRatio) && layer.aspectRatio > 0.0f);
    return read_surface(session, layer, Surface::Kind::Cylinder, read_radius(layer.radius),
                        {layer.centralAngle, layer.centralAngle / layer.aspectRatio, 0.0f, 0.0f});
}

Layer read_equirect(const Session& session, const XrCompositionLayerEquirect2KHR& layer) {
    verify(layer.centralHorizontalAngle >= 0.0f && layer.centralHorizontalAngle <= full_turn);
    verify(std::isfinite(layer.upperVerticalAngle) && std::isfinite(layer.lowerVerticalAngle));
    return read_surface(
        session, layer, Surface::Kind::Equirect, read_radius(layer.radius),
        {layer.centralHorizontalAngle, layer.upperVerticalAngle, layer.lowerVerticalAngle, 0.0f});
}

template <typename Input>
const Input& as(const XrCompositionLayerBaseHeader* layer) {
    return *reinterpret_cast<const Input*>(layer);
}

}  // namespace

std::vector<Layer> read_layers(const Session& session, const XrFrameEndInfo& info) {
    verify(info.layerCount <= max_layers, XR_ERROR_LAYER_LIMIT_EXCEEDED);
    verify(info.layerCount == 0 || info.layers != nullptr);
    const Instance& instance = session.instance();
    std::vector<Layer> layers;
    layers.reserve(info.layerCount);
    for (std::uint32_t i = 0; i < info.layerCount; ++i) {
        const XrCompositionLayerBaseHeader* const layer = info.layers[i];
        verify(layer != nullptr, XR_ERROR_LAYER_INVALID);
        switch (layer->type) {
            case XR_TYPE_COMPOSITION_LAYER_PROJECTION:
                layers.push_back(read_projection(session, as<XrCompositionLayerProjection>(layer)));
                break;
            case XR_TYPE_COMPOSITION_LAYER_QUAD:
                layers.push_back(read_quad(session, as<XrCompositionLayerQuad>(layer)));
                break;
            case XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR:
                verify(instance.has(XR_KHR_COMPOSITION_LAYER_CYLINDER_EXTENSION_NAME),
                       XR_ERROR_LAYER_INVALID);
                layers.push_back(read_cylinder(session, as<XrCompositionLayerCylinderKHR>(layer)));
                break;
            case XR_TYPE_COMPOSITION_LAYER_EQUIRECT2_KHR:
                verify(instance.has(XR_KHR_COMPOSITION_LAYER_EQUIRECT2_EXTENSION_NAME),
                       XR_ERROR_LAYER_INVALID);
                layers.push_back(read_equirect(session, as<XrCompositionLayerEquirect2KHR>(layer)));
                break;
            default:
                throw Refusal{XR_ERROR_LAYER_INVALID};
        }
    }
    return layers;
}

const Projection* rearmost_projection(const std::vector<Layer>& layers) {
    for (const Layer& layer : layers) {
        if (const auto* projection = std::get_if<Projection>(&layer.content)) return projection;
    }
    return nullptr;
}

}  // namespace foveray::simulator
