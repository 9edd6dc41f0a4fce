// XR_EXT_debug_utils: messengers and their filters, names, labels, and what the simulator itself says.
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

struct Heard {
    std::string function, message, object;
    std::vector<std::string> labels;
};

XRAPI_ATTR XrBool32 XRAPI_CALL listen(XrDebugUtilsMessageSeverityFlagsEXT, XrDebugUtilsMessageTypeFlagsEXT,
                                      const XrDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    Heard heard;
    heard.function = data->functionName ? data->functionName : "";
    heard.message = data->message;
    if (data->objectCount > 0 && data->objects[0].objectName) heard.object = data->objects[0].objectName;
    for (std::uint32_t i = 0; i < data->sessionLabelCount; ++i)
        heard.labels.emplace_back(data->sessionLabels[i].labelName);
    static_cast<std::vector<Heard>*>(user)->push_back(heard);
    return XR_FALSE;
}

constexpr auto error = XR_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
constexpr auto info = XR_DEBUG_UTILS_MESSAGE_SEVERITY_INFO_BIT_EXT;
constexpr auto general = XR_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
constexpr auto validation = XR_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;

class DebugMessages : public testing::Test {
  protected:
    DebugMessages() {
        set_environment({});
        client_ = std::make_unique<SimulatorClient>(headless_extensions);
        client_->create_headless_session();
    }

    XrDebugUtilsMessengerEXT create(XrDebugUtilsMessageSeverityFlagsEXT severities,
                                    XrDebugUtilsMessageTypeFlagsEXT types) {
        const XrDebugUtilsMessengerCreateInfoEXT create_info{
            XR_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT, nullptr, severities, types, listen, &heard_};
        XrDebugUtilsMessengerEXT messenger = XR_NULL_HANDLE;
        EXPECT_EQ(load<PFN_xrCreateDebugUtilsMessengerEXT>("xrCreateDebugUtilsMessengerEXT")(
                      client_->instance, &create_info, &messenger),
                  XR_SUCCESS);
        return messenger;
    }

    XrResult submit(XrDebugUtilsMessageSeverityFlagsEXT severity, XrDebugUtilsMessageTypeFlagsEXT types,
                    std::vector<XrDebugUtilsObjectNameInfoEXT> objects = {}) {
        XrDebugUtilsMessengerCallbackDataEXT data{};
        data.type = XR_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT;
        data.functionName = "worker";
        data.message = "testing";
        data.objectCount = static_cast<std::uint32_t>(objects.size());
        data.objects = objects.data();
        return load<PFN_xrSubmitDebugUtilsMessageEXT>("xrSubmitDebugUtilsMessageEXT")(client_->instance,
                                                                                      severity, types, &data);
    }

    template <typename Function>
    Function load(const char* name) {
        return client_->function<Function>(name);
    }

    std::unique_ptr<SimulatorClient> client_;
    std::vector<Heard> heard_;
};

TEST_F(DebugMessages, ReachMessengersThatWantThem) {
    const auto messenger = create(info | error, general);
    EXPECT_EQ(submit(info, general), XR_SUCCESS);
    ASSERT_EQ(heard_.size(), 1u);
    EXPECT_EQ(heard_[0].function, "worker");
    EXPECT_EQ(heard_[0].message, "testing");
    EXPECT_EQ(submit(XR_DEBUG_UTILS_MESSAGE_SEVERITY_VERBOSE_BIT_EXT, general), XR_SUCCESS);
    EXPECT_EQ(submit(info, XR_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT), XR_SUCCESS);
    EXPECT_EQ(heard_.size(), 1u) << "not asked for";
    create(error, general);
    EXPECT_EQ(submit(error, general), XR_SUCCESS);
    EXPECT_EQ(heard_.size(), 3u) << "both";
    EXPECT_EQ(load<PFN_xrDestroyDebugUtilsMessengerEXT>("xrDestroyDebugUtilsMessengerEXT")(messenger),
              XR_SUCCESS);
    EXPECT_EQ(submit(info, general), XR_SUCCESS);
    EXPECT_EQ(heard_.size(), 3u);
}

TEST_F(DebugMessages, CarryNamesAndLabels) {
    create(info, general);
    const auto handle = reinterpret_cast<std::uint64_t>(client_->session);
    const XrDebugUtilsObjectNameInfoEXT name{XR_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr,
                                             XR_OBJECT_TYPE_SESSION, handle, "the session"};
    const auto set_name = load<PFN_xrSetDebugUtilsObjectNameEXT>("xrSetDebugUtilsObjectNameEXT");
    ASSERT_XR_SUCCESS(set_name(client_->instance, &name));
    const auto begin =
        load<PFN_xrSessionBeginDebugUtilsLabelRegionEXT>("xrSessionBeginDebugUtilsLabelRegionEXT");
    const auto end = load<PFN_xrSessionEndDebugUtilsLabelRegionEXT>("xrSessionEndDebugUtilsLabelRegionEXT");
    const auto insert = load<PFN_xrSessionInsertDebugUtilsLabelEXT>("xrSessionInsertDebugUtilsLabelEXT");
    const auto label = [](const char* text) {
        return XrDebugUtilsLabelEXT{XR_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, text};
    };
    const auto outer = label("outer"), inner = label("inner"), here = label("here");
    ASSERT_XR_SUCCESS(begin(client_->session, &outer));
    ASSERT_XR_SUCCESS(begin(client_->session, &inner));
    ASSERT_XR_SUCCESS(insert(client_->session, &here));
    const XrDebugUtilsObjectNameInfoEXT object{XR_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr,
                                               XR_OBJECT_TYPE_SESSION, handle, nullptr};
    ASSERT_XR_SUCCESS(submit(info, general, {object}));
    ASSERT_FALSE(heard_.empty());
    EXPECT_EQ(heard_.back().object, "the session");
    EXPECT_EQ(heard_.back().labels, (std::vector<std::string>{"here", "inner", "outer"}));
    ASSERT_XR_SUCCESS(end(client_->session));
    ASSERT_XR_SUCCESS(submit(info, general, {object}));
    EXPECT_EQ(heard_.back().labels, std::vector<std::string>{"outer"});
    ASSERT_XR_SUCCESS(end(client_->session));
}

TEST_F(DebugMessages, TellWhatTheSimulatorRefuses) {
    create(error, validation);
    XrPath path = XR_NULL_PATH;
    EXPECT_EQ(xrStringToPath(client_->instance, "no path", &path), XR_ERROR_PATH_FORMAT_INVALID);
    ASSERT_EQ(heard_.size(), 1u);
    EXPECT_EQ(heard_[0].function, "xrStringToPath");
    EXPECT_EQ(heard_[0].message, "xrStringToPath answers XR_ERROR_PATH_FORMAT_INVALID");
    EXPECT_EQ(xrStringToPath(client_->instance, "/path", &path), XR_SUCCESS);
    EXPECT_EQ(heard_.size(), 1u);
}

TEST_F(DebugMessages, ArgumentsAreVerified) {
    XrDebugUtilsMessengerCreateInfoEXT create_info{
        XR_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT, nullptr, error, general, listen, nullptr};
    XrDebugUtilsMessengerEXT messenger = XR_NULL_HANDLE;
    const auto create = load<PFN_xrCreateDebugUtilsMessengerEXT>("xrCreateDebugUtilsMessengerEXT");
    const auto refuses = [&](auto change) {
        auto changed = create_info;
        change(changed);
        EXPECT_EQ(create(client_->instance, &changed, &messenger), XR_ERROR_VALIDATION_FAILURE);
    };
    refuses([](auto& c) { c.messageSeverities = 0; });
    refuses([](auto& c) { c.messageSeverities = 0x80000; });
    refuses([](auto& c) { c.messageTypes = 0; });
    refuses([](auto& c) { c.messageTypes = 0x100; });
    refuses([](auto& c) { c.userCallback = nullptr; });
    refuses([](auto& c) { c.type = XR_TYPE_UNKNOWN; });
    const XrDebugUtilsObjectNameInfoEXT nothing{XR_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr,
                                                XR_OBJECT_TYPE_UNKNOWN, 0, "name"};
    EXPECT_EQ(
        load<PFN_xrSetDebugUtilsObjectNameEXT>("xrSetDebugUtilsObjectNameEXT")(client_->instance, &nothing),
        XR_ERROR_VALIDATION_FAILURE);
}

}  // namespace
}  // namespace foveray::simulator_tests
