#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "base/headset_profile.h"
#include "base/image.h"
#include "render/reference/tracer.h"
#include "render/scene/load_scene.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/light_rig.h"

/// The acuity chart (HERR's figure 8) through the polar samples of a varjo-xr1.
namespace foveray::render {
namespace {

/// Where the chart has gratings, as assets/generate/acuity_chart.py sets them.
constexpr std::array rings = {5.0f, 10.0f, 20.0f, 30.0f, 40.0f};
constexpr std::array seen_meridians = {0.0f, 90.0f, 270.0f};  // stripes across the radius, and along it twice
constexpr std::array fine_meridians = {45.0f, 135.0f};        // likewise
constexpr std::uint32_t seen = 0, fine = 1;  // the gratings are the chart's first two objects
constexpr float fine_frequency = 0.75f;      // of the acuity's pixels a degree
constexpr std::uint32_t crop_pixels = 72;

class AcuityChart : public fakes::GpuTest {
  protected:
    AcuityChart()
        : scene_(scene::load_scene(assets_folder() / "scenes/acuity_chart.json")),
          headset_(read_headset_profile("varjo-xr1")),
          rig_(device(), scene_),
          tracer_(scene_, scene::SceneAnimator(scene_).advance(0)),
          eye_(scene_.nodes.back().local.translation) {}

    /// As large a part of a view as a patch is, its pixels as they are there.
    View crop_at(float eccentricity, float meridian) const {
        // The focus view where it reaches, else the context.
        const auto& profile = headset_.views[eccentricity < 12.0f ? 2 : 0];
        const float pitch =
            (std::tan(profile.fov.right) - std::tan(profile.fov.left)) / static_cast<float>(profile.size.x);
        const float t = std::tan(radians(eccentricity)), m = radians(meridian);
        const vec2 center(t * std::cos(m), t * std::sin(m));
        const float half = 0.5f * static_cast<float>(crop_pixels) * pitch;
        View view;
        view.role = profile.role;
        view.size = uvec2(crop_pixels);
        view.stage_from_eye.position = eye_;
        view.fov = {std::atan(center.x - half), std::atan(center.x + half), std::atan(center.y + half),
                    std::atan(center.y - half)};
        return view;
    }

    struct Contrast {
        double kept = 0.0;     // amplitude of the grating itself, part of the true one
        double pattern = 0.0;  // of all there is but the mean: as of a sine with so much power
    };

    /// Of a grating, `seen` or `fine`.
    Contrast contrast_at(LightRig& rig, std::uint32_t object, float eccentricity, float meridian) {
        Shot shot;
        shot.acuity = headset_.acuity;
        shot.every_pixel = false;
        shot.read_samples = false;
        shot.fovea.origin = eye_;
        shot.views = {crop_at(eccentricity, meridian)};
        const Picture picture = rig.render(shot).views[0];
        if (const char* folder = std::getenv("FOVERAY_TEST_PICTURES")) {
            Image image(picture.size.x, picture.size.y, 3);
            for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
                for (std::size_t c = 0; c < 3; ++c) {
                    image.pixels[3 * i + c] = static_cast<std::uint8_t>(
                        255.0f * srgb_from_linear(glm::clamp(picture.pixels[i].radiance.r, 0.0f, 1.0f)));
                }
            }
            write_png(std::filesystem::path(folder) / ("acuity_" + std::to_string(int(eccentricity)) + "_" +
                                                       std::to_string(int(meridian)) + ".png"),
                      image);
        }
        const float half_width = object == seen ? 5.0f : 15.0f;  // periods
        double n = 0.0, sum = 0.0, squares = 0.0, sine = 0.0, cosine = 0.0;
        for (std::uint32_t y = 0; y < picture.size.y; ++y) {
            for (std::uint32_t x = 0; x < picture.size.x; ++x) {
                const auto hit = tracer_.closest({dvec3(eye_), dvec3(direction_of(shot.views[0], x, y))});
                if (!hit || hit->object != object) continue;
                if (std::max(std::abs(hit->uv0.x), std::abs(hit->uv0.y)) > 0.8f * half_width) continue;
                const double value = picture.at(x, y).radiance.r, phase = 2.0 * pi * hit->uv0.x;
                n += 1.0, sum += value, squares += value * value;
                sine += value * std::sin(phase), cosine += value * std::cos(phase);
            }
        }
        EXPECT_GT(n, 300.0);
        EXPECT_NEAR(sum / n, 0.5, 0.02) << "the mean is not kept";
        const double mean = sum / n, variance = std::max(squares / n - mean * mean, 0.0);
        return {2.0 * std::hypot(sine / n, cosine / n) / mean, std::sqrt(2.0 * variance) / mean};
    }

    scene::Scene scene_;
    HeadsetProfile headset_;
    LightRig rig_;
    reference::Tracer tracer_;
    vec3 eye_;
};

TEST_F(AcuityChart, HalfTheContrastIsKeptAtAQuarterOfTheAcuity) {
    for (const float e : rings) {
        for (const float meridian : seen_meridians) {
            const Contrast contrast = contrast_at(rig_, seen, e, meridian);
            std::cout << e << " degrees, meridian " << meridian << ": " << contrast.kept << '\n';
            EXPECT_GE(contrast.kept, 0.5) << e << " degrees, meridian " << meridian;
        }
    }
    EXPECT_GE(contrast_at(rig_, seen, 0.0f, 0.0f).kept, 0.5);
}

/// The same chart with its gratings too fine at another frequency, from a texture of so many periods: its
/// levels then fall differently on the stripes.
scene::Scene with_fine_gratings(scene::Scene scene, float frequency, int periods) {
    scene::Primitive& gratings = scene.meshes[*scene.nodes[fine].mesh].primitives[0];
    for (vec2& uv : gratings.uv0) uv *= frequency / (fine_frequency * static_cast<float>(periods));
    const scene::TextureUse& use = scene.materials[gratings.material].base_color_texture;
    Image& stripes = scene.images[scene.textures[*use.texture].image].pixels;
    for (std::uint32_t y = 0; y < stripes.height; ++y) {
        for (std::uint32_t x = 0; x < stripes.width; ++x) {
            const float turns = static_cast<float>(periods) * (static_cast<float>(x) + 0.3f) /
                                static_cast<float>(stripes.width);
            const float shade = srgb_from_linear(0.5f + 0.5f * std::sin(2.0f * pi * turns));
            std::fill_n(stripes.at(x, y), 3, static_cast<std::uint8_t>(255.0f * shade + 0.5f));
        }
    }
    return scene;
}

// Of all that a grating above half the acuity's density leaves, its own stripes included, no eye sees a
// twentieth of its contrast: sensitivity falls to 1 at ppd / 2 from about 100, and is about 10 at ppd / 4,
// where 3/4 ppd would come back. What comes back of gratings nearer to ppd / 2 is finer, and seen less: by
// the same law 0.65 ppd, as 0.35, needs a quarter, and 0.55 more than half.
TEST_F(AcuityChart, NoFalsePatternIsSeenAboveHalfTheAcuity) {
    struct Fine {
        float frequency;  // of the acuity's pixels a degree
        int periods;      // a texture
        double most = 0.05;
    };
    for (const Fine f :
         {Fine{0.55f, 5, 0.2}, Fine{0.65f, 5, 0.12}, Fine{0.75f, 1}, Fine{0.75f, 5}, Fine{1.1f, 5}}) {
        const scene::Scene scene = with_fine_gratings(scene_, f.frequency, f.periods);
        LightRig rig(device(), scene);
        double worst = 0.0;
        for (const float e : rings) {
            for (const float meridian : fine_meridians) {
                const Contrast contrast = contrast_at(rig, fine, e, meridian);
                worst = std::max(worst, contrast.pattern);
                EXPECT_LE(contrast.pattern, f.most) << f.frequency << " ppd, " << f.periods << " periods, "
                                                    << e << " degrees, meridian " << meridian;
            }
        }
        std::cout << f.frequency << " ppd, " << f.periods << " periods a texture: " << worst << '\n';
    }
}

}  // namespace
}  // namespace foveray::render
