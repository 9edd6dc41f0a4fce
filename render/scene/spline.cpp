#include "render/scene/spline.h"

#include <algorithm>
#include <cmath>

namespace foveray::scene {
namespace {

float length_of(std::span<const vec4> points) {
    float length = 0.0f;
    for (std::size_t i = 1; i < points.size(); ++i) length += glm::length(points[i] - points[i - 1]);
    return length;
}

vec4 at(std::span<const vec4> points, float t) {
    const auto last = static_cast<int>(points.size()) - 1;
    const int i = std::clamp(static_cast<int>(t), 0, last - 1);
    const float f = t - static_cast<float>(i);
    const vec4 b = points[static_cast<std::size_t>(i)], c = points[static_cast<std::size_t>(i) + 1];
    const vec4 a = i > 0 ? points[static_cast<std::size_t>(i) - 1] : 2.0f * b - c;
    const vec4 d = i + 1 < last ? points[static_cast<std::size_t>(i) + 2] : 2.0f * c - b;
    const vec4 m0 = 0.5f * (c - a), m1 = 0.5f * (d - b);
    const float f2 = f * f, f3 = f2 * f;
    return (2.0f * f3 - 3.0f * f2 + 1.0f) * b + (f3 - 2.0f * f2 + f) * m0 + (3.0f * f2 - 2.0f * f3) * c +
           (f3 - f2) * m1;
}

void append_run(std::vector<vec4>& samples, std::span<const vec4> run, std::uint32_t count) {
    const auto segments = static_cast<float>(run.size() - 1);
    std::vector<vec4> fine;
    const std::size_t steps = 16 * (run.size() - 1);
    for (std::size_t i = 0; i <= steps; ++i) {
        fine.push_back(at(run, segments * static_cast<float>(i) / static_cast<float>(steps)));
    }
    const float total = length_of(fine);
    samples.push_back(run.front());
    float walked = 0.0f;
    std::uint32_t next = 1;
    for (std::size_t i = 1; i < fine.size() && next < count; ++i) {
        const float step = glm::length(fine[i] - fine[i - 1]);
        while (next < count) {
            const float wanted = total * static_cast<float>(next) / static_cast<float>(count);
            if (wanted > walked + step) break;
            samples.push_back(glm::mix(fine[i - 1], fine[i], step > 0.0f ? (wanted - walked) / step : 0.0f));
            ++next;
        }
        walked += step;
    }
    samples.push_back(run.back());
}

}  // namespace

std::vector<vec4> sample_spline(std::span<const vec4> points, std::uint32_t count) {
    std::vector<std::span<const vec4>> runs;
    std::size_t first = 0;
    for (std::size_t i = 1; i <= points.size(); ++i) {
        if (i < points.size() && points[i] != points[i - 1]) continue;
        if (i - first >= 2) runs.push_back(points.subspan(first, i - first));
        first = i;
    }
    float total = 0.0f;
    for (const auto run : runs) total += length_of(run);
    std::vector<vec4> samples;
    for (const auto run : runs) {
        const float part = length_of(run) / total * static_cast<float>(count);
        append_run(samples, run, std::max(1u, static_cast<std::uint32_t>(std::lround(part))));
    }
    return samples;
}

}  // namespace foveray::scene
