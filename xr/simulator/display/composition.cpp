#include "xr/simulator/display/composition.h"

#include <cmath>

#include "xr/simulator/space.h"

namespace foveray::simulator {
namespace {

vec4 to_vec4(const quat& q) { return {q.x, q.y, q.z, q.w}; }
vec4 tangents_of(const Fov& fov) {
    return {std::tan(fov.left), std::tan(fov.right), std::tan(fov.up), std::tan(fov.down)};
}

shared::CompositionDraw draw_for(const EyeDisplay& eye) {
    shared::CompositionDraw draw{};
    draw.tangents = tangents_of(eye.fov);
    const bool is_right = eye.eye == Eye::Right;
    draw.picture = {eye.size.x, eye.size.y, is_right ? eye.size.x * eye.size.y : 0, 0};
    return draw;
}

std::uint32_t flags_of(const Layer& layer) {
    std::uint32_t flags = 0;
    if (layer.flags & XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT)
        flags |= shared::COMPOSITION_SOURCE_ALPHA;
    if (layer.flags & XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT)
        flags |= shared::COMPOSITION_UNPREMULTIPLIED;
    if (layer.color) flags |= shared::COMPOSITION_SCALE_BIAS;
    return flags;
}

shared::CompositionSource source_of(const SubImage& image, const quat& source_from_eye, vec4 shape) {
    const auto& [offset, extent] = image.rect;
    return {to_vec4(source_from_eye), shape, vec4(offset.x, offset.y, extent.width, extent.height)};
}

bool is_seen_by(const Surface& surface, Eye eye) {
    return surface.eyes == XR_EYE_VISIBILITY_BOTH ||
           surface.eyes == (eye == Eye::Left ? XR_EYE_VISIBILITY_LEFT : XR_EYE_VISIBILITY_RIGHT);
}

bool has_area(const Surface& surface) {
    const vec4& shape = surface.shape;
    if (surface.kind == Surface::Kind::Equirect) return shape.x > 0.0f && shape.y != shape.z;
    return shape.x != 0.0f && shape.y != 0.0f;
}

std::uint32_t kind_of(Surface::Kind kind) {
    switch (kind) {
        case Surface::Kind::Quad:
            return shared::COMPOSITION_QUAD;
        case Surface::Kind::Cylinder:
            return shared::COMPOSITION_CYLINDER;
        default:
            return shared::COMPOSITION_EQUIRECT;
    }
}

/// `space_from_eye` is nothing where the head cannot be located.
void set_projection(LayerDraw& layer, const Projection& projection, const EyeDisplay& eye,
                    const std::optional<Pose>& space_from_eye) {
    const auto view_source = [&](const ProjectionView& view) {
        const quat view_from_eye =
            space_from_eye ? glm::conjugate(view.space_from_view.orientation) * space_from_eye->orientation
                           : quat(1.0f, 0.0f, 0.0f, 0.0f);
        return source_of(view.image, view_from_eye, tangents_of(view.fov));
    };
    const auto index = static_cast<std::size_t>(eye.eye);
    const ProjectionView& context = projection.views[index];
    layer.draw.what.x = shared::COMPOSITION_PROJECTION;
    layer.draw.source = view_source(context);
    layer.source = &context.image;
    if (projection.views.size() == 4) {
        const ProjectionView& focus = projection.views[2 + index];
        layer.draw.what.x = shared::COMPOSITION_FOCUSED_PROJECTION;
        layer.draw.focus = view_source(focus);
        layer.focus = &focus.image;
    }
}

void set_surface(LayerDraw& layer, const Surface& surface, const Pose& space_from_eye) {
    const Pose surface_from_eye = inverse(surface.space_from_surface) * space_from_eye;
    layer.draw.what.x = kind_of(surface.kind);
    layer.draw.origin = vec4(surface_from_eye.position, surface.radius);
    layer.draw.source = source_of(surface.image, surface_from_eye.orientation, surface.shape);
    layer.source = &surface.image;
}

}  // namespace

std::vector<LayerDraw> draw_layers(const SubmittedFrame& frame, const EyeDisplay& eye) {
    std::vector<LayerDraw> draws;
    for (const Layer& layer : frame.layers) {
        const HeadLocation head = locate_head(*layer.space, frame.display_time);
        std::optional<Pose> space_from_eye;
        if (head.flags & XR_VIEW_STATE_ORIENTATION_VALID_BIT)
            space_from_eye = head.base_from_head * eye.head_from_eye;

        LayerDraw drawn{draw_for(eye)};
        drawn.draw.what.y = flags_of(layer);
        if (layer.color) {
            drawn.draw.scale = layer.color->scale;
            drawn.draw.bias = layer.color->bias;
        }
        if (const auto* projection = std::get_if<Projection>(&layer.content)) {
            set_projection(drawn, *projection, eye, space_from_eye);
        } else {
            const auto& surface = std::get<Surface>(layer.content);
            if (!space_from_eye || !is_seen_by(surface, eye.eye) || !has_area(surface)) continue;
            set_surface(drawn, surface, *space_from_eye);
        }
        draws.push_back(drawn);
    }
    return draws;
}

shared::CompositionDraw draw_background(const SubmittedFrame& frame, const EyeDisplay& eye) {
    shared::CompositionDraw draw = draw_for(eye);
    draw.what.y = frame.blend_mode == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND ? shared::COMPOSITION_BLEND_ALPHA
                  : frame.blend_mode == XR_ENVIRONMENT_BLEND_MODE_ADDITIVE
                      ? shared::COMPOSITION_BLEND_ADDITIVE
                      : shared::COMPOSITION_BLEND_OPAQUE;
    draw.source.source_from_eye = to_vec4((frame.stage_from_head * eye.head_from_eye).orientation);
    return draw;
}

}  // namespace foveray::simulator
