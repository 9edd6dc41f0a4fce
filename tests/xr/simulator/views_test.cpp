// View configurations: sizes, fields of view, gaze-contingent focus, visibility mask.
#include <cmath>
#include <cstring>

#include "base/headset_profile.h"
#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

constexpr auto quad = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO;
constexpr auto stereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

std::vector<XrViewConfigurationView> configuration_views(const SimulatorClient& client,
                                                         XrViewConfigurationType type, bool foveated) {
    std::uint32_t count = 0;
    EXPECT_EQ(xrEnumerateViewConfigurationViews(client.instance, client.system, type, 0, &count, nullptr),
              XR_SUCCESS);
    std::vector<XrFoveatedViewConfigurationViewVARJO> follow(
        count, {XR_TYPE_FOVEATED_VIEW_CONFIGURATION_VIEW_VARJO, nullptr, foveated});
    std::vector<XrViewConfigurationView> views(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        views[i].type = XR_TYPE_VIEW_CONFIGURATION_VIEW;
        views[i].next = &follow[i];
    }
    EXPECT_EQ(
        xrEnumerateViewConfigurationViews(client.instance, client.system, type, count, &count, views.data()),
        XR_SUCCESS);
    return views;
}

bool lies_inside(const XrFovf& inner, const XrFovf& outer) {
    return inner.angleLeft >= outer.angleLeft && inner.angleRight <= outer.angleRight &&
           inner.angleDown >= outer.angleDown && inner.angleUp <= outer.angleUp &&
           inner.angleLeft < inner.angleRight && inner.angleDown < inner.angleUp;
}

TEST(Views, QuadViewsNeedTheirExtensionAndAFocusDisplay) {
    const auto types = [](const SimulatorClient& client) {
        std::vector<XrViewConfigurationType> list(2);
        std::uint32_t count = 0;
        EXPECT_EQ(xrEnumerateViewConfigurations(client.instance, client.system, 2, &count, list.data()),
                  XR_SUCCESS);
        list.resize(count);
        return list;
    };
    using Types = std::vector<XrViewConfigurationType>;
    set_environment({});
    EXPECT_EQ(types(SimulatorClient()), (Types{quad, stereo}));
    EXPECT_EQ(types(SimulatorClient({XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME})), Types{stereo});
    set_environment({{"PROFILE", "valve-index"}});
    EXPECT_EQ(types(SimulatorClient()), Types{stereo});
}

TEST(Views, SizesAreTheProfiles) {
    set_environment({{"PROFILE", "varjo-xr1"}});
    SimulatorClient client;
    const auto fixed = configuration_views(client, quad, false);
    ASSERT_EQ(fixed.size(), 4u);
    for (int eye = 0; eye < 2; ++eye) {
        EXPECT_EQ(fixed[eye].recommendedImageRectWidth, 1980u);
        EXPECT_EQ(fixed[eye].recommendedImageRectHeight, 1980u);
        EXPECT_EQ(fixed[2 + eye].recommendedImageRectWidth, 2400u);
        EXPECT_EQ(fixed[2 + eye].recommendedImageRectHeight, 1800u);
    }
    const auto foveated = configuration_views(client, quad, true);
    EXPECT_EQ(foveated[0].recommendedImageRectWidth, 1980u);
    EXPECT_EQ(foveated[2].recommendedImageRectWidth, 1200u);
    EXPECT_EQ(foveated[2].recommendedImageRectHeight, 900u);
}

TEST(Views, FocusSharesTheContextsPoseAndLiesInside) {
    fakes::TemporaryFolder folder;
    Session script = make_session(40);
    for (int i = 0; i < 40; ++i) {
        const float angle = 0.5f * static_cast<float>(i);
        script.head.push_back(
            {from_seconds(i / 30.0),
             {glm::angleAxis(angle, glm::normalize(vec3(1, 2, 3))), vec3(0.1f * angle, 1.7f, -0.2f)}});
        // Round the field of view and beyond its edges.
        const vec3 direction(2.0f * std::cos(angle), 2.0f * std::sin(angle), -1.0f);
        script.gaze.push_back({from_seconds(i / 30.0), true, vec3(0), glm::normalize(direction)});
    }
    write_session(folder.path() / "s", script);
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    const XrSpace stage = client.reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    for (int i = 0; i < 39; ++i) {
        const XrTime time = client.empty_frame().predictedDisplayTime;
        for (const bool foveated : {false, true}) {
            const auto views = client.locate_views(stage, time, quad, foveated);
            ASSERT_EQ(views.size(), 4u);
            for (int eye = 0; eye < 2; ++eye) {
                EXPECT_EQ(std::memcmp(&views[eye].pose, &views[2 + eye].pose, sizeof(XrPosef)), 0);
                EXPECT_TRUE(lies_inside(views[2 + eye].fov, views[eye].fov)) << i;
            }
        }
    }
}

TEST(Views, FoveatedFocusFollowsTheGazeAndHoldsThroughBlinks) {
    fakes::TemporaryFolder folder;
    Session script = make_session(10);
    const vec3 direction = glm::normalize(vec3(0.3f, -0.2f, -1.0f));
    script.gaze = {{from_seconds(1 / 30.0), true, vec3(0), direction},
                   {from_seconds(2 / 30.0), false, vec3(0), vec3(0, 0, -1)}};
    write_session(folder.path() / "s", script);
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    const XrSpace stage = client.reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    const auto focus_centre = [&](bool foveated) {
        const XrTime time = client.empty_frame().predictedDisplayTime;
        const XrFovf fov = client.locate_views(stage, time, quad, foveated)[2].fov;
        return vec2(std::tan(fov.angleLeft) + std::tan(fov.angleRight),
                    std::tan(fov.angleUp) + std::tan(fov.angleDown)) *
               0.5f;
    };
    EXPECT_NEAR(glm::length(focus_centre(true)), 0.0f, 1e-6f) << "no gaze yet";
    EXPECT_NEAR(glm::distance(focus_centre(true), vec2(0.3f, -0.2f)), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::distance(focus_centre(true), vec2(0.3f, -0.2f)), 0.0f, 1e-5f) << "blink";
    EXPECT_NEAR(glm::length(focus_centre(false)), 0.0f, 1e-6f) << "not asked to follow";
}

TEST(Views, EyesStandOneIpdApart) {
    set_environment({});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    const XrTime time = client.empty_frame().predictedDisplayTime;
    XrViewStateFlags flags = 0;
    const auto views = client.locate_views(client.reference_space(XR_REFERENCE_SPACE_TYPE_STAGE), time,
                                           stereo, false, &flags);
    ASSERT_EQ(views.size(), 2u);
    EXPECT_EQ(flags, XrViewStateFlags{15});
    EXPECT_FLOAT_EQ(views[0].pose.position.x, -0.0315f);
    EXPECT_FLOAT_EQ(views[1].pose.position.x, 0.0315f);
    EXPECT_FLOAT_EQ(views[0].pose.position.y, 1.6f);
}

TEST(Views, VisibilityMaskCoversTheRestOfTheView) {
    set_environment({{"PROFILE", "ci-stereo"}});
    SimulatorClient client;
    client.create_session();
    const auto get_mask = client.function<PFN_xrGetVisibilityMaskKHR>("xrGetVisibilityMaskKHR");
    const auto read = [&](std::uint32_t view, XrVisibilityMaskTypeKHR type) {
        XrVisibilityMaskKHR mask{};
        mask.type = XR_TYPE_VISIBILITY_MASK_KHR;
        EXPECT_EQ(get_mask(client.session, stereo, view, type, &mask), XR_SUCCESS);
        std::vector<XrVector2f> vertices(mask.vertexCountOutput);
        std::vector<std::uint32_t> indices(mask.indexCountOutput);
        mask.vertexCapacityInput = mask.vertexCountOutput;
        mask.indexCapacityInput = mask.indexCountOutput;
        mask.vertices = vertices.data();
        mask.indices = indices.data();
        EXPECT_EQ(get_mask(client.session, stereo, view, type, &mask), XR_SUCCESS);
        std::vector<vec2> corners;
        for (const std::uint32_t i : indices) corners.emplace_back(vertices.at(i).x, vertices.at(i).y);
        return corners;
    };
    const auto covers = [](const std::vector<vec2>& corners, vec2 p) {
        const auto side = [](vec2 a, vec2 b, vec2 c) {
            return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        };
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            EXPECT_GT(side(corners[i], corners[i + 1], corners[i + 2]), 0.0f) << "counter-clockwise";
            if (side(corners[i], corners[i + 1], p) >= 0 && side(corners[i + 1], corners[i + 2], p) >= 0 &&
                side(corners[i + 2], corners[i], p) >= 0) {
                return true;
            }
        }
        return false;
    };
    const HeadsetProfile profile = read_headset_profile("ci-stereo");
    for (std::uint32_t view = 0; view < 2; ++view) {
        const auto hidden = read(view, XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR);
        const auto seen = read(view, XR_VISIBILITY_MASK_TYPE_VISIBLE_TRIANGLE_MESH_KHR);
        EXPECT_EQ(read(view, XR_VISIBILITY_MASK_TYPE_LINE_LOOP_KHR).size(), profile.hidden_outline.size());
        int hidden_count = 0;
        for (int i = 0; i < 40 * 40; ++i) {
            const vec2 uv((static_cast<float>(i % 40) + 0.5f) / 40, (static_cast<float>(i / 40) + 0.5f) / 40);
            const vec3 direction = direction_at(profile.views[view].fov, uv);
            const bool is_hidden = covers(hidden, direction);
            EXPECT_NE(is_hidden, covers(seen, direction)) << uv.x << ' ' << uv.y;
            hidden_count += is_hidden;
        }
        EXPECT_GT(hidden_count, 100);
        EXPECT_LT(hidden_count, 500);
    }
    set_environment({});
}

TEST(Views, NothingIsHiddenWithoutAnOutline) {
    set_environment({});
    SimulatorClient client;
    client.create_session();
    XrVisibilityMaskKHR mask{};
    mask.type = XR_TYPE_VISIBILITY_MASK_KHR;
    EXPECT_EQ(client.function<PFN_xrGetVisibilityMaskKHR>("xrGetVisibilityMaskKHR")(
                  client.session, quad, 3, XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, &mask),
              XR_SUCCESS);
    EXPECT_EQ(mask.vertexCountOutput, 0u);
    EXPECT_EQ(mask.indexCountOutput, 0u);
}

}  // namespace
}  // namespace foveray::simulator_tests
