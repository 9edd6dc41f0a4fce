#include "xr/simulator/layers.h"

#include <cmath>

#include "xr/simulator/convert.h"
#include "xr/simulator/limits.h"
#include "xr/simulator/session.h"
#include "xr/simulator/space.h"

namespace foveray::simulator {
namespace {

// Clients compute 2 pi in single precision.
constexpr float full_turn = 2.0f * pi + 1e-5f;

SubImage read_sub_image(const Session& session, const XrSwapchainSubImage& info) {
    SubImage image{get<Swapchain>(info.swapchain), info.imageRect, info.imageArrayIndex};
    const XrSwapchainCreateInfo& swapchain = image.swapchain->info();
    verify(&image.swapchain->session() == &session);
    verify(image.swapchain->shown() != VK_NULL_HANDLE, XR_ERROR_LAYER_INVALID);
    const auto& [offset, extent] = image.rect;
    verify(offset.x >= 0 && offset.y >= 0 && extent.width > 0 && extent.height > 0 &&
               std::int64_t{offset.x} + extent.width <= swapchain.width &&
               std::int64_t{offset.y} + extent.height <= swapchain.height,
           XR_ERROR_SWAPCHAIN_RECT_INVALID);
    verify(image.array_index < swapchain.arraySize && swapchain.faceCount == 1);
    return image;
}

/// What all layers have.
template <typename Layer>
void verify_base(const Session& session, const Layer& layer) {
    constexpr XrCompositionLayerFlags known = XR_COMPOSITION_LAYER_CORRECT_CHROMATIC_ABERRATION_BIT |
                                              XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT |
                                              XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
    verify((layer.layerFlags & ~known) == 0);
    verify(&get<Space>(layer.space)->session() == &session);
}

/// What layers with a picture of their own have: quads, cylinders, equirectangular ones.
template <typename Layer>
void verify_surface(const Session& session, const Layer& layer) {
    verify_base(session, layer);
    verify(layer.eyeVisibility >= XR_EYE_VISIBILITY_BOTH && layer.eyeVisibility <= XR_EYE_VISIBILITY_RIGHT);
    verify(is_valid(layer.pose), XR_ERROR_POSE_INVALID);
    verify(!is_depth_format(read_sub_image(session, layer.subImage).swapchain->format()),
           XR_ERROR_LAYER_INVALID);
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

ProjectionLayer read_projection(const Session& session, const XrCompositionLayerProjection& layer) {
    verify_base(session, layer);
    verify(layer.viewCount == session.view_count() && layer.views != nullptr);
    ProjectionLayer result;
    result.flags = layer.layerFlags;
    for (std::uint32_t i = 0; i < layer.viewCount; ++i) {
        const XrCompositionLayerProjectionView& view = layer.views[i];
        verify_structure(&view, XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
        verify(is_valid(view.pose), XR_ERROR_POSE_INVALID);
        verify_fov(view.fov);
        result.views.push_back({from_xr(view.fov), read_sub_image(session, view.subImage)});
        verify(!is_depth_format(result.views.back().image.swapchain->format()), XR_ERROR_LAYER_INVALID);
        if (const auto* depth = find_input<XrCompositionLayerDepthInfoKHR>(
                view.next, XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
            depth && session.instance().has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME)) {
            verify_depth(session, *depth);
        }
    }
    return result;
}

void verify_quad(const Session& session, const XrCompositionLayerQuad& layer) {
    verify_surface(session, layer);
    verify(std::isfinite(layer.size.width) && std::isfinite(layer.size.height));
}

/// Zero and infinity put the surface at infinity.
void verify_radius(float radius) { verify(radius >= 0.0f); }

void verify_cylinder(const Session& session, const XrCompositionLayerCylinderKHR& layer) {
    verify_surface(session, layer);
    verify_radius(layer.radius);
    verify(layer.centralAngle >= 0.0f && layer.centralAngle <= full_turn);
    verify(std::isfinite(layer.aspectRatio) && layer.aspectRatio > 0.0f);
}

void verify_equirect(const Session& session, const XrCompositionLayerEquirect2KHR& layer) {
    verify_surface(session, layer);
    verify_radius(layer.radius);
    verify(layer.centralHorizontalAngle >= 0.0f && layer.centralHorizontalAngle <= full_turn);
    verify(std::isfinite(layer.upperVerticalAngle) && std::isfinite(layer.lowerVerticalAngle));
}

}  // namespace

std::vector<ProjectionLayer> read_layers(const Session& session, const XrFrameEndInfo& info) {
    verify(info.layerCount <= max_layers, XR_ERROR_LAYER_LIMIT_EXCEEDED);
    verify(info.layerCount == 0 || info.layers != nullptr);
    std::vector<ProjectionLayer> layers;
    for (std::uint32_t i = 0; i < info.layerCount; ++i) {
        const XrCompositionLayerBaseHeader* const layer = info.layers[i];
        verify(layer != nullptr, XR_ERROR_LAYER_INVALID);
        switch (layer->type) {
            case XR_TYPE_COMPOSITION_LAYER_PROJECTION:
                layers.push_back(
                    read_projection(session, *reinterpret_cast<const XrCompositionLayerProjection*>(layer)));
                break;
            case XR_TYPE_COMPOSITION_LAYER_QUAD:
                verify_quad(session, *reinterpret_cast<const XrCompositionLayerQuad*>(layer));
                break;
            case XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR:
                verify(session.instance().has(XR_KHR_COMPOSITION_LAYER_CYLINDER_EXTENSION_NAME),
                       XR_ERROR_LAYER_INVALID);
                verify_cylinder(session, *reinterpret_cast<const XrCompositionLayerCylinderKHR*>(layer));
                break;
            case XR_TYPE_COMPOSITION_LAYER_EQUIRECT2_KHR:
                verify(session.instance().has(XR_KHR_COMPOSITION_LAYER_EQUIRECT2_EXTENSION_NAME),
                       XR_ERROR_LAYER_INVALID);
                verify_equirect(session, *reinterpret_cast<const XrCompositionLayerEquirect2KHR*>(layer));
                break;
            default:
                throw Refusal{XR_ERROR_LAYER_INVALID};
        }
    }
    return layers;
}

}  // namespace foveray::simulator
