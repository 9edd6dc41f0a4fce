// Stereo registration of the whole frame: what a headset shows of a thing lies where the runtime's views say,
// for each eye, context and focus, with the head and the stage turned away from the identity.
#include <cmath>

#include <gtest/gtest.h>

#include "app/frame_loop.h"
#include "base/image.h"
#include "base/session.h"
#include "render/scene/load_scene.h"
#include "tests/fakes/gltf_builder.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray::app {
namespace {

using Quad = std::array<vec3, 4>;  // corners in order

constexpr float brightness = 0.5f;

/// OpenXR's projection from the meaning of its angles: the tangent of angleLeft is on the left edge.
glm::dvec2 pixel_of(const View& view, vec3 point) {
    const glm::dvec3 p(glm::conjugate(view.stage_from_eye.orientation) *
                       (point - view.stage_from_eye.position));
    const double left = std::tan(double{view.fov.left}), right = std::tan(double{view.fov.right});
    const double up = std::tan(double{view.fov.up}), down = std::tan(double{view.fov.down});
    return {(p.x / -p.z - left) / (right - left) * view.size.x,
            (up - p.y / -p.z) / (up - down) * view.size.y};
}

glm::dvec2 centroid(const std::array<glm::dvec2, 4>& corners) {
    glm::dvec2 sum(0.0);
    double area = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % 4];
        const double cross = a.x * b.y - b.x * a.y;
        sum += (a + b) * cross / 3.0;
        area += cross;
    }
    return sum / area;
}

double linear(std::uint8_t srgb) {
    const double v = srgb / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

class RegistrationTest : public testing::Test {
  public:
    /// Pixels that single quads and the mean of all may be off.
    struct Limits {
        double largest, mean;
    };

  protected:
    /// Small bright quads round the head in stage space, 2 m away, and the scene that holds them.
    void make_scene() {
        fakes::GltfBuilder gltf;
        gltf.json["extensionsUsed"] = {"KHR_materials_unlit"};
        const int material = gltf.add(
            "materials",
            {{"doubleSided", true},
             {"extensions", {{"KHR_materials_unlit", Json::object()}}},
             {"pbrMetallicRoughness", {{"baseColorFactor", {brightness, brightness, brightness, 1}}}}});
        std::vector<vec2> directions = {{-5, 4}, {5, -4}, {0, 0}};
        for (const float yaw : {-30.0f, -15.0f, 15.0f, 30.0f})
            for (const float pitch : {-24.0f, 1.0f, 24.0f}) directions.emplace_back(yaw, pitch);
        for (const vec2 direction : directions) {
            const quat aim = glm::angleAxis(radians(-direction.x), vec3(0, 1, 0)) *
                             glm::angleAxis(radians(direction.y), vec3(1, 0, 0)) *
                             glm::angleAxis(0.3f, vec3(0, 0, 1));
            Quad quad;
            std::vector<float> positions;
            constexpr float half = 0.045f;
            for (std::size_t i = 0; i < 4; ++i) {
                const vec3 corner(i == 0 || i == 3 ? -half : half, i < 2 ? -half : half, -2.0f);
                quad[i] = transform_point(stage_from_head_, aim * corner);
                const vec3 world = transform_point(world_from_stage_, quad[i]);
                positions.insert(positions.end(), {world.x, world.y, world.z});
            }
            quads_.push_back(quad);
            const int attribute = gltf.add_accessor(positions, "VEC3");
            const int indices = gltf.add_accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
            gltf.add_root({{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", attribute}}},
                                                   {"indices", indices},
                                                   {"material", material}})}});
        }
        folder_.write("targets.gltf", gltf.text());
        const auto& [q, p] = world_from_stage_;
        const Json scene = {
            {"format", "foveray-scene"},
            {"version", 1},
            {"models", {{{"file", "targets.gltf"}}}},
            {"environment", {{"color", {0, 0, 0}}}},
            {"world_from_stage", {{"position", {p.x, p.y, p.z}}, {"orientation", {q.x, q.y, q.z, q.w}}}}};
        folder_.write("scene.json", scene.dump());
    }

    /// Shows one frame on `profile` and returns the views that the runtime asked for.
    std::vector<View> show(const std::string& profile, bool every_pixel) {
        Session session;
        session.headset = profile;
        session.rate_hz = 30;
        session.frames = 1;
        session.head = {{0, stage_from_head_}};
        session.gaze = {{0, true, {}, glm::normalize(vec3(0.1f, 0.05f, -1))}};
        write_session(folder_ / "session", session);
        xr::SimulatorOptions simulator;
        simulator.profile = profile;
        simulator.session = folder_ / "session";
        simulator.virtual_time = true;
        simulator.capture = folder_ / "shown";
        xr::Headset headset(xr::RuntimeChoice::Simulator, simulator);
        const gpu::Device device({.validation = true}, headset.device_source());
        const xr::StopAtEnd stop_at_end(headset);
        Settings settings;
        settings.tone_mapping = "none";
        settings.reference_samples = 16;
        headset.start(device, BlendMode::Opaque, settings.near_m, settings.far_m);
        const auto scene = std::make_shared<const scene::Scene>(scene::load_scene(folder_ / "scene.json"));
        FrameLoop loop({device, headset, scene, nullptr, std::nullopt, read_headset_profile(profile).acuity,
                        every_pixel});
        EXPECT_EQ(headset.poll(), xr::Headset::State::Running);
        const FrameLoop::Step step = loop.step(settings).value();
        EXPECT_TRUE(step.rendered);
        loop.wait();
        EXPECT_TRUE(device.validation_messages().empty());
        return step.frame.views;
    }

    struct Offsets {
        int count = 0;
        double largest = 0.0;
        glm::dvec2 mean{0.0};
    };
    /// How far the quads' pictures lie from their places, in pixels.
    Offsets offsets(const View& view, const std::filesystem::path& file) const {
        const Image shown = read_image(file, 3);
        EXPECT_EQ(uvec2(shown.width, shown.height), view.size);
        Offsets result;
        for (const Quad& quad : quads_) {
            std::array<glm::dvec2, 4> corners;
            glm::dvec2 low(1e9), high(-1e9);
            for (std::size_t i = 0; i < 4; ++i) {
                corners[i] = pixel_of(view, quad[i]);
                low = glm::min(low, corners[i]), high = glm::max(high, corners[i]);
            }
            constexpr double margin = 3.0;
            low -= margin, high += margin;
            if (low.x < 0 || low.y < 0 || high.x >= view.size.x || high.y >= view.size.y) continue;
            glm::dvec2 sum(0.0);
            double weight = 0.0;
            for (auto y = static_cast<std::uint32_t>(low.y); y <= high.y; ++y) {
                for (auto x = static_cast<std::uint32_t>(low.x); x <= high.x; ++x) {
                    const double light = linear(*shown.at(x, y));
                    sum += light * glm::dvec2(x + 0.5, y + 0.5);
                    weight += light;
                }
            }
            EXPECT_GT(weight, 5.0) << "nothing shows there";
            const glm::dvec2 offset = sum / weight - centroid(corners);
            result.largest = std::max(result.largest, glm::length(offset));
            result.mean += offset;
            ++result.count;
        }
        result.mean /= std::max(result.count, 1);
        return result;
    }

    void check(const std::string& profile, bool every_pixel, Limits context, Limits focus) {
        make_scene();
        const std::vector<View> views = show(profile, every_pixel);
        for (std::size_t i = 0; i < views.size(); ++i) {
            SCOPED_TRACE(profile + ", view " + std::to_string(i));
            const Offsets found =
                offsets(views[i], folder_ / ("shown/frame_00000_view" + std::to_string(i) + ".png"));
            const bool is_context = views[i].role == ViewRole::Context;
            const Limits limits = is_context ? context : focus;
            EXPECT_GE(found.count, is_context ? 10 : 3);
            EXPECT_LT(found.largest, limits.largest);
            EXPECT_LT(glm::length(found.mean), limits.mean);
        }
    }

    const Pose stage_from_head_{glm::normalize(quat(0.9f, 0.15f, -0.35f, 0.1f)), {0.4f, 1.3f, -0.7f}};
    const Pose world_from_stage_{glm::normalize(quat(0.7f, 0.0f, 0.7f, 0.1f)), {3.0f, -0.5f, 2.0f}};
    std::vector<Quad> quads_;
    fakes::TemporaryFolder folder_;
};

// The mean of a pixel's 16 sample positions lies 0.1 pixels off its centre.
constexpr RegistrationTest::Limits every_pixel_limits{0.1, 0.05};
// Away from the gaze a polar sample is larger than a pixel, and single quads are off by a part of one.
constexpr RegistrationTest::Limits polar_context{2.2, 0.35}, polar_focus{0.4, 0.2};

TEST_F(RegistrationTest, EveryPixelOfContextAndFocus) {
    check("ci", true, every_pixel_limits, every_pixel_limits);
}
TEST_F(RegistrationTest, EveryPixelOfAsymmetricViews) {
    check("ci-stereo", true, every_pixel_limits, every_pixel_limits);
}
TEST_F(RegistrationTest, PolarImageOfContextAndFocus) { check("ci", false, polar_context, polar_focus); }
TEST_F(RegistrationTest, PolarImageOfAsymmetricViews) {
    check("ci-stereo", false, polar_context, polar_focus);
}

}  // namespace
}  // namespace foveray::app
