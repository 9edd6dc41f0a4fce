#include <algorithm>
#include <cmath>

#include "render/scene/animator.h"

namespace foveray::scene {
namespace {

quat quat_at(const float* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

void store_unit(std::vector<float>& out, quat q) {
    q = glm::normalize(q);
    out = {q.x, q.y, q.z, q.w};
}

/// glTF 2.0 appendix C.5: Hermite spline with tangents scaled by the span.
void cubic(std::vector<float>& out, const float* key, std::uint32_t width, float t, float span) {
    const float t2 = t * t, t3 = t2 * t;
    const float *value = key + width, *out_tangent = key + 2 * width;
    const float *next_in_tangent = key + 3 * width, *next_value = key + 4 * width;
    for (std::uint32_t c = 0; c < width; ++c) {
        out[c] = (2 * t3 - 3 * t2 + 1) * value[c] + span * (t3 - 2 * t2 + t) * out_tangent[c] +
                 (-2 * t3 + 3 * t2) * next_value[c] + span * (t3 - t2) * next_in_tangent[c];
    }
}

}  // namespace

std::vector<float> sample(const AnimationChannel& channel, float seconds) {
    const std::vector<float>& times = channel.times;
    const std::uint32_t width = channel.width;
    const bool spline = channel.interpolation == Interpolation::CubicSpline;
    const std::size_t stride = spline ? 3 * width : width;
    const auto key = [&](std::size_t i) { return channel.values.data() + i * stride; };
    const auto value = [&](std::size_t i) { return key(i) + (spline ? width : 0); };

    const auto after = std::upper_bound(times.begin(), times.end(), seconds);
    const std::size_t next = static_cast<std::size_t>(after - times.begin());
    const std::size_t last = next == 0 ? 0 : next - 1;
    std::vector<float> out(value(last), value(last) + width);
    const bool rotation = channel.property == AnimatedProperty::Rotation;

    if (next > 0 && next < times.size() && channel.interpolation != Interpolation::Step) {
        const float span = times[next] - times[last];
        const float t = (seconds - times[last]) / span;
        if (spline) {
            cubic(out, key(last), width, t, span);
        } else if (rotation) {
            store_unit(out, glm::slerp(quat_at(value(last)), quat_at(value(next)), t));
        } else {
            for (std::uint32_t c = 0; c < width; ++c) out[c] = std::lerp(out[c], value(next)[c], t);
        }
    }
    if (rotation) store_unit(out, quat_at(out.data()));
    return out;
}

}  // namespace foveray::scene
