#include "tests/render/geometry/comparison.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/render/geometry/scene_rig.h"

namespace foveray::render {

void expect_near(vec3 a, vec3 b, float tolerance, const char* what) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << what << ": " << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

Comparison compare(const std::vector<shared::Surface>& found, const reference::Tracer& tracer,
                   const View& view) {
    Comparison result;
    const auto directions = directions_of(view);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const glm::dvec3 direction = glm::normalize(directions[i]);
        const shared::Surface& s = found[i];
        const auto hit = tracer.closest({.origin = view.stage_from_eye.position, .direction = direction},
                                        reference::Side::FrontOnly);
        ++result.compared;
        if (hit.has_value() != (s.kind == shared::SURFACE_VIRTUAL) ||
            (hit && (hit->object != s.instance || std::abs(hit->distance - double{s.distance}) > 1e-2))) {
            ++result.other_object;
            continue;
        }
        if (!hit) {
            EXPECT_EQ(s.kind, shared::SURFACE_NONE);
            EXPECT_LT(s.distance, 0.0f);
            continue;
        }
        ++result.hits;
        const vec3 view_direction(direction);
        const float side = hit->front ? 1.0f : -1.0f;
        result.back_faces += !hit->front;
        EXPECT_EQ((s.flags & shared::SURFACE_FLAG_BACK_FACE) != 0, !hit->front);
        EXPECT_EQ(s.material, hit->material);
        EXPECT_NEAR(s.distance, hit->distance, 2e-5 * hit->distance);
        expect_near(s.position, vec3(hit->position), 1e-4f, "position");
        expect_near(s.geometric_normal, side * hit->geometric_normal, 2e-3f, "geometric normal");
        EXPECT_LE(glm::dot(s.geometric_normal, view_direction), 1e-4f);
        const vec3 shading = side * hit->shading_normal;
        // The reference interpolates world normals; under an uneven scale that differs a little.
        if (glm::dot(shading, view_direction) < -0.02f) expect_near(s.normal, shading, 0.06f, "normal");
        EXPECT_LT(glm::dot(s.normal, view_direction), 0.0f);
        expect_near(s.base_color, vec3(hit->base_color), 1e-3f, "base colour");
    }
    return result;
}

}  // namespace foveray::render
