#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "base/headset_profile.h"
#include "base/image.h"
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

// Issue 2, "Done when": polar at one sample is at most 1 dB worse than full resolution at one sample, both
// against 64 samples low-passed to the acuity there (-3 dB at ppd / 2 cycles a degree). Errors are taken
// together over scenes: where a crop holds few edges, where they happen to fall decides.
TEST_F(SharpnessTest, PolarIsAsSharpAsItClaims) {
    const HeadsetProfile headset = read_headset_profile("varjo-xr1");
    const char* pictures = std::getenv("FOVERAY_TEST_PICTURES");  // a folder to leave them in
    const Place places[] = {{"gaze", 2, 0.0f}, {"5 degrees", 2, 5.0f}, {"20 degrees", 0, 20.0f}};
    double full_error[3] = {}, polar_error[3] = {};
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const scene::Scene scene = clutter_scene(seed);
        LightRig rig(device(), scene);
        for (int i = 0; i < 3; ++i) {
            const Place& place = places[i];
            const auto& profile = headset.views[place.view];
            Shot shot;
            shot.acuity = headset.acuity;
            shot.read_samples = false;
            shot.views = {crop_of(profile, place.off_axis_degrees, crop_pixels)};
            const FloatImage full = radiance_of(rig.render(shot).views[0]);
            shot.every_pixel = false;
            const FloatImage polar = radiance_of(rig.render(shot).views[0]);
            shot.every_pixel = true;
            shot.settings.reference_samples = 64;
            shot.views = {crop_of(profile, place.off_axis_degrees, crop_pixels + 2 * border)};
            const FloatImage truth = radiance_of(rig.render(shot).views[0]);
            const FloatImage reference = low_pass(truth, low_pass_sigma(headset, place));
            const double full_here = error(full, reference), polar_here = error(polar, reference);
            std::cout << "scene " << seed << ", " << place.name << ": full " << psnr(full_here)
                      << " dB, polar " << psnr(polar_here) << " dB\n";
            full_error[i] += full_here / 3.0;
            polar_error[i] += polar_here / 3.0;
            if (pictures) {
                const std::string stem =
                    std::to_string(seed) + "_" + std::to_string(int(place.off_axis_degrees));
                const std::filesystem::path folder = pictures;
                write_png(folder / (stem + "_full.png"), encoded(full));
                write_png(folder / (stem + "_polar.png"), encoded(polar));
                write_png(folder / (stem + "_reference.png"), encoded(reference));
            }
        }
    }
    for (int i = 0; i < 3; ++i) {
        std::cout << places[i].name << ": full " << psnr(full_error[i]) << " dB, polar "
                  << psnr(polar_error[i]) << " dB\n";
        EXPECT_GE(psnr(polar_error[i]), psnr(full_error[i]) - 1.0) << places[i].name;
    }
}

}  // namespace
}  // namespace foveray::render
