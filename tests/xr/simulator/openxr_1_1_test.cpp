// OpenXR 1.1 where the headers have it, and the extensions that became it.
#include <cmath>
#include <cstring>

#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

TEST(ApiVersion, IsThatOfTheHeadersOrOlder) {
    set_environment({});
    const auto create = [](XrVersion version) {
        XrInstanceCreateInfo info{};
        info.type = XR_TYPE_INSTANCE_CREATE_INFO;
        std::strcpy(info.applicationInfo.applicationName, "versions");
        info.applicationInfo.apiVersion = version;
        XrInstance instance = XR_NULL_HANDLE;
        const XrResult result = xrCreateInstance(&info, &instance);
        if (instance) xrDestroyInstance(instance);
        return result;
    };
    constexpr std::uint32_t newest = XR_VERSION_MINOR(XR_CURRENT_API_VERSION);
    for (std::uint32_t minor = 0; minor <= newest; ++minor) {
        EXPECT_EQ(create(XR_MAKE_VERSION(1, minor, 0)), XR_SUCCESS) << minor;
        EXPECT_EQ(create(XR_MAKE_VERSION(1, minor, 0xffff)), XR_SUCCESS) << "patches do not matter";
    }
    EXPECT_EQ(create(XR_MAKE_VERSION(1, newest + 1, 0)), XR_ERROR_API_VERSION_UNSUPPORTED);
    EXPECT_EQ(create(XR_MAKE_VERSION(2, 0, 0)), XR_ERROR_API_VERSION_UNSUPPORTED);
}

#ifdef XR_VERSION_1_1

constexpr XrVersion v1_0 = XR_API_VERSION_1_0, v1_1 = XR_API_VERSION_1_1;
const char* const headless = XR_MND_HEADLESS_EXTENSION_NAME;

TEST(OpenXR1_1, FunctionsNeedTheirVersionOrExtension) {
    set_environment({});
    const char* const extension = XR_KHR_LOCATE_SPACES_EXTENSION_NAME;
    for (const auto& [version, extensions, has_core, has_extension] :
         {std::tuple{v1_0, std::vector<const char*>{}, false, false},
          {v1_0, {extension}, false, true},
          {v1_1, {}, true, false},
          {v1_1, {extension}, true, true}}) {
        SimulatorClient client(extensions, version);
        for (const auto& [name, expected] :
             {std::pair{"xrLocateSpaces", has_core}, {"xrLocateSpacesKHR", has_extension}}) {
            PFN_xrVoidFunction function = nullptr;
            EXPECT_EQ(xrGetInstanceProcAddr(client.instance, name, &function),
                      expected ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED)
                << name;
            EXPECT_EQ(function != nullptr, expected) << name;
        }
    }
}

TEST(OpenXR1_1, NewNamesAreTold) {
    set_environment({});
    SimulatorClient client({}, v1_1);
    char text[XR_MAX_RESULT_STRING_SIZE];
    ASSERT_XR_SUCCESS(xrResultToString(client.instance, XR_ERROR_EXTENSION_DEPENDENCY_NOT_ENABLED_KHR, text));
    EXPECT_STREQ(text, "XR_ERROR_EXTENSION_DEPENDENCY_NOT_ENABLED");
    ASSERT_XR_SUCCESS(xrStructureTypeToString(client.instance, XR_TYPE_SPACES_LOCATE_INFO_KHR, text));
    EXPECT_STREQ(text, "XR_TYPE_SPACES_LOCATE_INFO");
}

TEST(OpenXR1_1, QuadViewsNeedAFocusDisplay) {
    set_environment({{"PROFILE", "quest-pro"}});
    SimulatorClient client({}, v1_1);
    std::uint32_t count = 0;
    EXPECT_EQ(xrEnumerateViewConfigurationViews(client.instance, client.system,
                                                XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO_WITH_FOVEATED_INSET,
                                                0, &count, nullptr),
              XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
}

TEST(OpenXR1_1, QuadViewsAreInItsCore) {
    set_environment({});
    SimulatorClient client({XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME}, v1_1);
    client.create_session();
    constexpr auto quad = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO_WITH_FOVEATED_INSET;
    client.begin_session(quad);
    const XrTime time = client.empty_frame().predictedDisplayTime;
    const auto views =
        client.locate_views(client.reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL), time, quad, false);
    ASSERT_EQ(views.size(), 4u);
    for (int eye = 0; eye < 2; ++eye) {
        EXPECT_EQ(std::memcmp(&views[eye].pose, &views[2 + eye].pose, sizeof(XrPosef)), 0);
        EXPECT_LT(views[eye].fov.angleLeft, views[2 + eye].fov.angleLeft);
        EXPECT_GT(views[eye].fov.angleUp, views[2 + eye].fov.angleUp);
    }
}

class Scripted1_1 : public testing::Test {
  protected:
    void play(const Session& script, const std::vector<const char*>& extensions, XrVersion version) {
        write_session(folder_.path(), script);
        set_environment({{"SESSION", folder_.path()}});
        client_ = std::make_unique<SimulatorClient>(extensions, version);
        client_->create_headless_session();
        client_->begin_session();
    }
    template <typename Event>
    std::vector<Event> take_events(XrStructureType type) {
        client_->take_states();
        std::vector<Event> taken;
        for (const XrEventDataBuffer& event : client_->other_events) {
            if (event.type == type) taken.push_back(reinterpret_cast<const Event&>(event));
        }
        return taken;
    }

    fakes::TemporaryFolder folder_;
    std::unique_ptr<SimulatorClient> client_;
};

TEST_F(Scripted1_1, SpacesOfAListAreLocatedAsEachAlone) {
    Session script = make_session(60);
    script.head = {{0, {quat(1, 0, 0, 0), vec3(0, 1.6f, 0)}},
                   {from_seconds(1.0), {glm::angleAxis(1.0f, vec3(0, 1, 0)), vec3(1, 1.6f, 0)}}};
    script.events = {{from_seconds(1.5), "head_tracking_lost", ""}};
    play(script, {headless}, v1_1);
    const XrTime start = client_->empty_frame().predictedDisplayTime;
    const XrSpace stage = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    const std::vector<XrSpace> spaces{
        client_->reference_space(XR_REFERENCE_SPACE_TYPE_VIEW, {{0, 0, 0, 1}, {0, 0, -2}}), stage,
        client_->reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL)};
    std::vector<XrSpaceLocationData> locations(3);
    std::vector<XrSpaceVelocityData> velocities(3);
    XrSpaceVelocities moving{XR_TYPE_SPACE_VELOCITIES, nullptr, 3, velocities.data()};
    XrSpaceLocations found{XR_TYPE_SPACE_LOCATIONS, &moving, 3, locations.data()};
    const XrSession session = client_->session;
    for (const double seconds : {0.5, 1.7}) {
        const XrTime time = start + from_seconds(seconds);
        const XrSpacesLocateInfo info{XR_TYPE_SPACES_LOCATE_INFO, nullptr, stage, time, 3, spaces.data()};
        ASSERT_XR_SUCCESS(xrLocateSpaces(session, &info, &found));
        for (std::size_t i = 0; i < 3; ++i) {
            XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY, nullptr, 0, {}, {}};
            const XrSpaceLocation location = client_->locate(spaces[i], stage, time, &velocity);
            EXPECT_EQ(locations[i].locationFlags, location.locationFlags) << i;
            EXPECT_EQ(std::memcmp(&locations[i].pose, &location.pose, sizeof(XrPosef)), 0) << i;
            EXPECT_EQ(velocities[i].velocityFlags, velocity.velocityFlags) << i;
            EXPECT_EQ(velocities[i].linearVelocity.z, velocity.linearVelocity.z) << i;
            EXPECT_EQ(velocities[i].angularVelocity.y, velocity.angularVelocity.y) << i;
        }
        EXPECT_EQ(locations[0].locationFlags != 0, seconds < 1.5) << "the head is lost, the stage is not";
        EXPECT_NE(locations[1].locationFlags, 0u);
    }
    EXPECT_EQ(velocities[0].velocityFlags, 0u);

    const auto refuse = [&](auto change, XrResult result, const char* what) {
        XrSpacesLocateInfo info{XR_TYPE_SPACES_LOCATE_INFO, nullptr, stage, start, 3, spaces.data()};
        XrSpaceVelocities bad_velocities = moving;
        XrSpaceLocations bad{XR_TYPE_SPACE_LOCATIONS, &bad_velocities, 3, locations.data()};
        change(info, bad, bad_velocities);
        EXPECT_EQ(xrLocateSpaces(session, &info, &bad), result) << what;
    };
    constexpr auto invalid = XR_ERROR_VALIDATION_FAILURE;
    refuse([](auto& i, auto&, auto&) { i.time = 0; }, XR_ERROR_TIME_INVALID, "time 0");
    refuse([](auto& i, auto&, auto&) { i.time = -42; }, XR_ERROR_TIME_INVALID, "negative time");
    refuse([](auto& i, auto& l, auto&) { i.spaceCount = l.locationCount = 0; }, invalid, "no spaces");
    refuse([](auto&, auto& l, auto&) { l.locationCount = 2; }, invalid, "too little room");
    refuse([](auto& i, auto&, auto& v) { i.spaceCount = v.velocityCount = 2; }, invalid, "too much room");
    refuse([](auto&, auto&, auto& v) { v.velocityCount = 2; }, invalid, "too little room for velocities");
    refuse([](auto&, auto&, auto& v) { v.velocities = nullptr; }, invalid, "none");
    refuse([](auto& i, auto&, auto&) { i.spaces = nullptr; }, invalid, "no list");
    refuse([](auto& i, auto&, auto&) { i.type = XR_TYPE_UNKNOWN; }, invalid, "type");
    refuse([](auto& i, auto&, auto&) { i.baseSpace = XR_NULL_HANDLE; }, XR_ERROR_HANDLE_INVALID, "base");
    const std::vector<XrSpace> with_garbage{spaces[0], XR_NULL_HANDLE, spaces[2]};
    refuse([&](auto& i, auto&, auto&) { i.spaces = with_garbage.data(); }, XR_ERROR_HANDLE_INVALID, "space");
    EXPECT_EQ(xrLocateSpaces(XR_NULL_HANDLE, nullptr, nullptr), XR_ERROR_HANDLE_INVALID);
}

TEST_F(Scripted1_1, LocalFloorStandsBelowLocal) {
    Session script = make_session(60);
    const Pose later{glm::angleAxis(radians(90.0f), vec3(0, 1, 0)), vec3(2, 1.5f, 1)};
    script.head = {{0, {quat(1, 0, 0, 0), vec3(0, 1.6f, 0)}}, {from_seconds(1 / 30.0), later}};
    script.events = {{from_seconds(2 / 30.0), "recenter", ""}};
    for (const auto& [extensions, version] :
         {std::pair{std::vector{headless}, v1_1}, {{headless, XR_EXT_LOCAL_FLOOR_EXTENSION_NAME}, v1_0}}) {
        play(script, extensions, version);
        const XrTime start = client_->empty_frame().predictedDisplayTime;
        const XrSpace floor = client_->reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR);
        const XrSpace local = client_->reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
        const XrSpace stage = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
        EXPECT_FLOAT_EQ(client_->locate(floor, local, start).pose.position.y, -1.6f);
        client_->empty_frame();
        const XrTime time = client_->empty_frame().predictedDisplayTime;
        const XrPosef now = client_->locate(floor, stage, time).pose;
        EXPECT_NEAR(now.position.x, 2.0f, 1e-6f);
        EXPECT_EQ(now.position.y, 0.0f);
        EXPECT_NEAR(now.orientation.y, std::sin(radians(45.0f)), 1e-6f);

        const auto changes = take_events<XrEventDataReferenceSpaceChangePending>(
            XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING);
        ASSERT_EQ(changes.size(), 2u);
        EXPECT_EQ(changes[0].referenceSpaceType, XR_REFERENCE_SPACE_TYPE_LOCAL);
        EXPECT_EQ(changes[1].referenceSpaceType, XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR);
        EXPECT_EQ(changes[0].changeTime, changes[1].changeTime);
        EXPECT_NEAR(changes[0].poseInPreviousSpace.position.y, -0.1f, 1e-5f);
        EXPECT_NEAR(changes[1].poseInPreviousSpace.position.x, 2.0f, 1e-5f);
        EXPECT_EQ(changes[1].poseInPreviousSpace.position.y, 0.0f);
        XrExtent2Df bounds{};
        EXPECT_EQ(
            xrGetReferenceSpaceBoundsRect(client_->session, XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR, &bounds),
            XR_SPACE_BOUNDS_UNAVAILABLE);
        client_.reset();
    }
    play(script, {headless}, v1_0);
    std::uint32_t count = 0;
    ASSERT_XR_SUCCESS(xrEnumerateReferenceSpaces(client_->session, 0, &count, nullptr));
    EXPECT_EQ(count, 3u);
    XrSpace space = XR_NULL_HANDLE;
    const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO,
                                          nullptr,
                                          XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR,
                                          {{0, 0, 0, 1}, {0, 0, 0}}};
    EXPECT_EQ(xrCreateReferenceSpace(client_->session, &info, &space), XR_ERROR_REFERENCE_SPACE_UNSUPPORTED);
}

TEST_F(Scripted1_1, PresenceIsToldWhenASessionBeginsAndWhenItChanges) {
    Session script = make_session(60);
    script.events = {{from_seconds(2 / 30.0), "user_absent", ""},
                     {from_seconds(4 / 30.0), "user_present", ""}};
    play(script, {headless, XR_EXT_USER_PRESENCE_EXTENSION_NAME}, v1_0);
    std::string told;
    for (int frame = 0; frame < 6; ++frame) {
        client_->empty_frame();
        for (const auto& event :
             take_events<XrEventDataUserPresenceChangedEXT>(XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT)) {
            EXPECT_EQ(event.session, client_->session);
            told += event.isUserPresent ? 'p' : 'a';
        }
        told += '.';
    }
    EXPECT_EQ(told, "p.a..p...");

    for (const bool enabled : {true, false}) {
        client_.reset();
        play(script,
             enabled ? std::vector{headless, XR_EXT_USER_PRESENCE_EXTENSION_NAME} : std::vector{headless},
             v1_1);
        XrSystemUserPresencePropertiesEXT presence{XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT, nullptr,
                                                   XR_FALSE};
        XrSystemProperties properties{};
        properties.type = XR_TYPE_SYSTEM_PROPERTIES;
        properties.next = &presence;
        ASSERT_XR_SUCCESS(xrGetSystemProperties(client_->instance, client_->system, &properties));
        EXPECT_EQ(bool(presence.supportsUserPresence), enabled);
        client_->empty_frame();
        const auto events =
            take_events<XrEventDataUserPresenceChangedEXT>(XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT);
        EXPECT_EQ(events.size(), enabled ? 1u : 0u);
    }
}

#endif

}  // namespace
}  // namespace foveray::simulator_tests
