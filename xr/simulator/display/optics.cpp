#include "xr/simulator/display/optics.h"

#include <algorithm>
#include <cmath>

namespace foveray::simulator {
namespace {

struct TangentRange {
    float low, high;
};

/// A range of `width` round `centre`, moved inside `limits`.
TangentRange place(float centre, float width, TangentRange limits) {
    const float low = std::clamp(centre - width / 2, limits.low, std::max(limits.low, limits.high - width));
    return {low, std::min(low + width, limits.high)};
}

/// Pixels a unit of tangent.
vec2 density(const HeadsetProfile::ViewProfile& view) {
    return vec2(view.size) / vec2(std::tan(view.fov.right) - std::tan(view.fov.left),
                                  std::tan(view.fov.up) - std::tan(view.fov.down));
}

std::uint32_t even(float size) {
    return std::max(2u, 2u * static_cast<std::uint32_t>(std::lround(size / 2.0f)));
}

std::vector<vec2> outline_of(const HeadsetProfile& profile, Eye eye) {
    std::vector<vec2> outline = profile.hidden_outline;
    if (eye == Eye::Right) {
        for (vec2& point : outline) point.x = -point.x;
        std::ranges::reverse(outline);  // still counter-clockwise
    }
    return outline;
}

}  // namespace

std::vector<HeadsetProfile::ViewProfile> views_of(const HeadsetProfile& profile,
                                                  XrViewConfigurationType type) {
    if (type == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) return {profile.views[0], profile.views[1]};
    if (type == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO && profile.views.size() == 4)
        return profile.views;
    return {};
}

uvec2 foveated_size(const HeadsetProfile& profile, const HeadsetProfile::ViewProfile& view) {
    if (view.role == ViewRole::Context) return view.size;
    return uvec2(glm::round(vec2(view.size) * profile.foveated_focus_scale));
}

Fov foveated_fov(const HeadsetProfile& profile, const HeadsetProfile::ViewProfile& view, vec3 direction) {
    if (view.role == ViewRole::Context || direction.z >= -0.01f) return view.fov;
    const Fov& context = profile.views[view.eye == Eye::Left ? 0 : 1].fov;
    const float width = (std::tan(view.fov.right) - std::tan(view.fov.left)) * profile.foveated_focus_scale;
    const float height = (std::tan(view.fov.up) - std::tan(view.fov.down)) * profile.foveated_focus_scale;
    const auto [left, right] =
        place(direction.x / -direction.z, width, {std::tan(context.left), std::tan(context.right)});
    const auto [down, up] =
        place(direction.y / -direction.z, height, {std::tan(context.down), std::tan(context.up)});
    // Rounding must not push an edge past the context's.
    return {std::max(std::atan(left), context.left), std::min(std::atan(right), context.right),
            std::min(std::atan(up), context.up), std::max(std::atan(down), context.down)};
}

EyeDisplay eye_display(const HeadsetProfile& profile, XrViewConfigurationType type, Eye eye, float max_size) {
    const auto views = views_of(profile, type);
    const auto index = static_cast<std::size_t>(eye);
    const HeadsetProfile::ViewProfile& context = views[index];
    vec2 size(context.size);
    if (views.size() == 4) {
        const vec2 ratio = density(views[2 + index]) / density(context);
        size *= std::max({1.0f, ratio.x, ratio.y});  // one factor, so that pixels keep their shape
    }
    size *= std::min(1.0f, max_size / std::max(size.x, size.y));
    return {eye, context.fov, {even(size.x), even(size.y)}, head_from_eye(profile, eye)};
}

Pose head_from_eye(const HeadsetProfile& profile, Eye eye) {
    const float x = eye == Eye::Left ? -profile.ipd / 2 : profile.ipd / 2;
    return {quat(1.0f, 0.0f, 0.0f, 0.0f), vec3(x, 0.0f, 0.0f)};
}

VisibilityMask visibility_mask(const HeadsetProfile& profile, const HeadsetProfile::ViewProfile& view,
                               XrVisibilityMaskTypeKHR type) {
    VisibilityMask mask;
    if (view.role == ViewRole::Focus || profile.hidden_outline.empty()) return mask;
    mask.vertices = outline_of(profile, view.eye);
    const auto n = static_cast<std::uint32_t>(mask.vertices.size());
    switch (type) {
        case XR_VISIBILITY_MASK_TYPE_LINE_LOOP_KHR:
            for (std::uint32_t i = 0; i < n; ++i) mask.indices.push_back(i);
            break;
        case XR_VISIBILITY_MASK_TYPE_VISIBLE_TRIANGLE_MESH_KHR:
            for (std::uint32_t i = 2; i < n; ++i) mask.indices.insert(mask.indices.end(), {0, i - 1, i});
            break;
        default: {  // A ring from the outline to the same outline beyond the view's corners.
            vec2 centre(0.0f);
            for (const vec2& point : mask.vertices) centre += point / static_cast<float>(n);
            float nearest = INFINITY;  // distance of the outline's edges from its centre
            for (std::uint32_t i = 0; i < n; ++i) {
                const vec2 a = mask.vertices[i], edge = glm::normalize(mask.vertices[(i + 1) % n] - a);
                nearest = std::min(nearest, edge.x * (centre.y - a.y) - edge.y * (centre.x - a.x));
            }
            const Fov& fov = view.fov;
            float farthest = 0.0f;  // corner of the view from the same centre
            for (const float x : {fov.left, fov.right}) {
                for (const float y : {fov.up, fov.down}) {
                    farthest = std::max(farthest, glm::distance(centre, vec2(std::tan(x), std::tan(y))));
                }
            }
            const float scale = std::max(farthest / nearest, 1.0f);
            for (std::uint32_t i = 0; i < n; ++i) {
                mask.vertices.push_back(centre + (mask.vertices[i] - centre) * scale);
                const std::uint32_t j = (i + 1) % n;
                mask.indices.insert(mask.indices.end(), {i, n + i, n + j, i, n + j, j});
            }
        }
    }
    return mask;
}

}  // namespace foveray::simulator
