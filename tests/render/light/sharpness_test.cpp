#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <span>

#include "app/offscreen/offscreen.h"
#include "base/headset_profile.h"
#include "base/image.h"
#include "render/scene/load_scene.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/clutter_scene.h"
#include "tests/render/light/light_rig.h"

namespace foveray::render {
namespace {

using SharpnessTest = fakes::GpuTest;

constexpr std::uint32_t crop_pixels = 48;
constexpr std::uint32_t border = 5;  // rendered round the crop for the low pass

/// A square part of a view, its pixels as they are there, centred `degrees` from the view's axis towards
/// upper right.
View crop_of(const HeadsetProfile::ViewProfile& profile, float off_axis_degrees, std::uint32_t pixels) {
    const float pitch =
        (std::tan(profile.fov.right) - std::tan(profile.fov.left)) / static_cast<float>(profile.size.x);
    const float t = std::tan(radians(off_axis_degrees)), half = 0.5f * static_cast<float>(pixels) * pitch;
    const vec2 center = t * glm::normalize(vec2(2.0f, 1.0f));
    View view;
    view.role = profile.role;
    view.size = uvec2(pixels);
    view.fov = {std::atan(center.x - half), std::atan(center.x + half), std::atan(center.y + half),
                std::atan(center.y - half)};
    return view;
}

/// Gaussian, `sigma` in pixels; leaves the border out.
FloatImage low_pass(const FloatImage& image, float sigma) {
    const int reach = static_cast<int>(border);
    std::vector<float> weights;
    float total = 0.0f;
    for (int i = -reach; i <= reach; ++i) {
        // The pixel's own share of the Gaussian, not the value at its centre: sigma may be below a pixel.
        const auto edge = [&](float x) { return std::erf(x / (std::sqrt(2.0f) * sigma)); };
        weights.push_back(edge(static_cast<float>(i) + 0.5f) - edge(static_cast<float>(i) - 0.5f));
        total += weights.back();
    }
    FloatImage result(image.width - 2 * border, image.height - 2 * border, 3);
    for (std::uint32_t y = 0; y < result.height; ++y) {
        for (std::uint32_t x = 0; x < result.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                double sum = 0.0;
                for (std::uint32_t j = 0; j <= 2 * border; ++j)
                    for (std::uint32_t i = 0; i <= 2 * border; ++i)
                        sum += weights[i] * weights[j] * image.at(x + i, y + j)[c];
                result.at(x, y)[c] = static_cast<float>(sum / (total * total));
            }
        }
    }
    return result;
}

Image encoded(const FloatImage& image) {
    Image result(image.width, image.height, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        result.pixels[i] = static_cast<std::uint8_t>(
            srgb_from_linear(std::clamp(image.pixels[i], 0.0f, 1.0f)) * 255.0f + 0.5f);
    }
    return result;
}

/// Keeps the picture in the folder FOVERAY_TEST_PICTURES, if that is set.
void leave(const std::string& name, const FloatImage& image) {
    const char* folder = std::getenv("FOVERAY_TEST_PICTURES");
    if (folder) write_png(std::filesystem::path(folder) / (name + ".png"), encoded(image));
}

/// Mean squared error of what the display shows.
double error(const FloatImage& a, const FloatImage& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = double{srgb_from_linear(std::clamp(a.pixels[i], 0.0f, 1.0f))} -
                         double{srgb_from_linear(std::clamp(b.pixels[i], 0.0f, 1.0f))};
        sum += d * d;
    }
    return sum / static_cast<double>(a.pixels.size());
}

double psnr(double mean_squared_error) { return -10.0 * std::log10(mean_squared_error); }

struct Place {
    const char* name;
    std::size_t view;  // of the profile: 0 context, 2 focus
    float off_axis_degrees;
};

/// Standard deviation in pixels of the Gaussian that leaves half the power at half the acuity's density.
float low_pass_sigma(const HeadsetProfile& headset, const Place& place) {
    const auto& profile = headset.views[place.view];
    const float e = place.off_axis_degrees;
    const float ppd = std::min(headset.acuity.cap_ppd, headset.acuity.a / (e + headset.acuity.b));
    const float sigma_degrees = std::sqrt(std::log(2.0f)) / (2.0f * pi * 0.5f * ppd);
    const float pitch =
        (std::tan(profile.fov.right) - std::tan(profile.fov.left)) / static_cast<float>(profile.size.x);
    return sigma_degrees / (degrees(pitch) * std::pow(std::cos(radians(e)), 1.5f));
}

/// Mean squared errors against 64 samples low-passed to the acuity there (-3 dB at ppd / 2 cycles a degree).
struct Errors {
    double full = 0.0;
    std::vector<double> polar;  // by size
};

/// `shot`: all but views and grid. `polar_sizes`: samples an eye; (0, 0): as many as the acuity asks for.
Errors measure(LightRig& rig, Shot shot, const Place& place, const Pose& head,
               std::span<const uvec2> polar_sizes, const std::string& name) {
    const HeadsetProfile headset = read_headset_profile("varjo-xr1");
    const auto& profile = headset.views[place.view];
    shot.acuity = headset.acuity;
    shot.read_samples = false;
    shot.fovea.origin = head.position;
    shot.fovea.direction = transform_direction(head, {0.0f, 0.0f, -1.0f});
    const auto render = [&](std::uint32_t pixels) {
        shot.views = {crop_of(profile, place.off_axis_degrees, pixels)};
        shot.views[0].stage_from_eye = head;
        return radiance_of(rig.render(shot).views[0]);
    };
    const FloatImage full = render(crop_pixels);
    const Settings settings = shot.settings;
    shot.settings.reference_samples = 64;
    shot.settings.shadow_samples = std::min(settings.shadow_samples, 2);
    const FloatImage reference = low_pass(render(crop_pixels + 2 * border), low_pass_sigma(headset, place));
    leave(name + "_full", full);
    leave(name + "_reference", reference);
    Errors errors{error(full, reference), {}};
    std::cout << name << ": full " << psnr(errors.full);
    shot.settings = settings;
    shot.every_pixel = false;
    for (const uvec2 size : polar_sizes) {
        if (size.x > 0) {
            app::Shot sized;
            sized.acuity = headset.acuity;
            app::set_polar_size(sized, size);
            shot.settings.resolution_scale = sized.settings.resolution_scale;
            shot.settings.angular_ratio = sized.settings.angular_ratio;
        }
        const FloatImage polar = render(crop_pixels);
        leave(name + "_polar_" + std::to_string(size.x), polar);
        errors.polar.push_back(error(polar, reference));
        std::cout << " dB, polar " << psnr(errors.polar.back());
    }
    std::cout << " dB\n";
    return errors;
}

/// Issue 2, "Done when": polar at one sample is at most 1 dB worse than full resolution at one sample. Errors
/// are taken together over pictures: where a crop holds few edges, where they happen to fall decides.
void expect_as_sharp(std::span<const Errors> pictures, const std::string& name) {
    double full = 0.0;
    std::vector<double> polar(pictures[0].polar.size(), 0.0);
    for (const Errors& errors : pictures) {
        full += errors.full / static_cast<double>(pictures.size());
        for (std::size_t i = 0; i < polar.size(); ++i)
            polar[i] += errors.polar[i] / static_cast<double>(pictures.size());
    }
    for (const double each : polar) {
        std::cout << name << ": full " << psnr(full) << " dB, polar " << psnr(each) << " dB\n";
        EXPECT_GE(psnr(each), psnr(full) - 1.0) << name;
    }
}

constexpr Place places[] = {{"gaze", 2, 0.0f}, {"5 degrees", 2, 5.0f}, {"20 degrees", 0, 20.0f}};

TEST_F(SharpnessTest, PolarIsAsSharpAsItClaims) {
    std::vector<Errors> errors[3];
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const scene::Scene scene = clutter_scene(seed);
        LightRig rig(device(), scene);
        for (int i = 0; i < 3; ++i) {
            errors[i].push_back(measure(rig, {}, places[i], {}, std::array{uvec2(0)},
                                        "scene " + std::to_string(seed) + ", " + places[i].name));
        }
    }
    for (int i = 0; i < 3; ++i) expect_as_sharp(errors[i], places[i].name);
}

// The polar images of HERR's table 1 in its hall, without what is noisy at a sample a pixel (full resolution
// would lose by it) and the probes, whose light has no edges.
TEST_F(SharpnessTest, PolarIsAsSharpInHerrsHall) {
    const scene::Scene scene = scene::load_scene(assets_folder() / "scenes/herr.json");
    LightRig rig(device(), scene);
    std::vector<Errors> errors[3];
    Shot shot;
    shot.settings.probes = false;
    shot.settings.ambient_occlusion_samples = 0;
    shot.settings.shadow_samples = 64;
    const std::array sizes{uvec2(788, 768), uvec2(1024, 1024)};
    const vec3 eye(0.0f, 1.52f, 3.5f);
    int picture = 0;
    for (const vec3 target : {vec3(-0.02f, 0.9f, -1.2f), vec3(0.5f, 0.6f, 0.6f), vec3(-0.6f, 0.8f, 0.0f),
                              vec3(0.1f, 0.4f, -1.1f)}) {
        for (int i = 0; i < 3; ++i) {
            errors[i].push_back(measure(rig, shot, places[i], look_at(eye, target), sizes,
                                        "hall " + std::to_string(picture) + ", " + places[i].name));
        }
        ++picture;
    }
    for (int i = 0; i < 3; ++i) expect_as_sharp(errors[i], places[i].name);
}

}  // namespace
}  // namespace foveray::render
