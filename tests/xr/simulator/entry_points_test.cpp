// The library itself: negotiation, function lookup, handles, and what every call refuses.
#include <cstring>
#include <dlfcn.h>
#include <set>

#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

// As in the loader design document.
struct LoaderInfo {
    std::uint32_t type = 1, version = 1;
    std::size_t size = sizeof(LoaderInfo);
    std::uint32_t min_interface = 1, max_interface = 1;
    XrVersion min_api = XR_MAKE_VERSION(1, 0, 0), max_api = XR_MAKE_VERSION(1, 0x3ff, 0xfff);
};
struct RuntimeRequest {
    std::uint32_t type = 3, version = 1;
    std::size_t size = sizeof(RuntimeRequest);
    std::uint32_t interface = 0;
    XrVersion api = 0;
    PFN_xrGetInstanceProcAddr get = nullptr;
};
using Negotiate = XrResult (*)(const LoaderInfo*, RuntimeRequest*);

class DirectTest : public testing::Test {
  protected:
    DirectTest() {
        set_environment({});
        library_ = dlopen(SIMULATOR_LIBRARY, RTLD_NOW | RTLD_LOCAL);
        if (library_)
            negotiate_ = reinterpret_cast<Negotiate>(dlsym(library_, "xrNegotiateLoaderRuntimeInterface"));
    }
    void SetUp() override {
        ASSERT_NE(negotiate_, nullptr) << dlerror();
        ASSERT_EQ(negotiate_(&loader_, &runtime_), XR_SUCCESS);
    }

    template <typename Function>
    Function load(XrInstance instance, const char* name) {
        PFN_xrVoidFunction found = nullptr;
        EXPECT_EQ(runtime_.get(instance, name, &found), XR_SUCCESS) << name;
        return reinterpret_cast<Function>(found);
    }

    XrInstance create_instance() {
        XrInstanceCreateInfo info{};
        info.type = XR_TYPE_INSTANCE_CREATE_INFO;
        std::strcpy(info.applicationInfo.applicationName, "direct");
        info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
        XrInstance instance = XR_NULL_HANDLE;
        EXPECT_EQ(load<PFN_xrCreateInstance>(XR_NULL_HANDLE, "xrCreateInstance")(&info, &instance),
                  XR_SUCCESS);
        return instance;
    }

    void* library_ = nullptr;
    Negotiate negotiate_ = nullptr;
    LoaderInfo loader_;
    RuntimeRequest runtime_;
};

TEST_F(DirectTest, NegotiationStatesVersionsAndRefusesStrangers) {
    EXPECT_EQ(runtime_.interface, 1u);
    EXPECT_EQ(XR_VERSION_MAJOR(runtime_.api), 1u);
    EXPECT_EQ(XR_VERSION_MINOR(runtime_.api), 0u);
    EXPECT_EQ(negotiate_(nullptr, &runtime_), XR_ERROR_INITIALIZATION_FAILED);
    EXPECT_EQ(negotiate_(&loader_, nullptr), XR_ERROR_INITIALIZATION_FAILED);
    LoaderInfo future;
    future.min_interface = future.max_interface = 2;
    EXPECT_EQ(negotiate_(&future, &runtime_), XR_ERROR_INITIALIZATION_FAILED);
    LoaderInfo wrong_size;
    wrong_size.size = 4;
    EXPECT_EQ(negotiate_(&wrong_size, &runtime_), XR_ERROR_INITIALIZATION_FAILED);
}

TEST_F(DirectTest, OnlyNegotiationIsExported) {
    EXPECT_EQ(dlsym(library_, "xrCreateInstance"), nullptr);
    EXPECT_EQ(dlsym(library_, "xrGetInstanceProcAddr"), nullptr);
}

TEST_F(DirectTest, FunctionsNeedTheirInstanceAndExtension) {
    PFN_xrVoidFunction found = nullptr;
    EXPECT_EQ(runtime_.get(XR_NULL_HANDLE, "xrGetSystem", &found), XR_ERROR_HANDLE_INVALID);
    EXPECT_EQ(runtime_.get(XR_NULL_HANDLE, "xrCreateInstance", nullptr), XR_ERROR_VALIDATION_FAILURE);
    const XrInstance instance = create_instance();
    EXPECT_EQ(runtime_.get(instance, "xrGetSystem", &found), XR_SUCCESS);
    EXPECT_EQ(runtime_.get(instance, "xrNoSuchFunction", &found), XR_ERROR_FUNCTION_UNSUPPORTED);
    EXPECT_EQ(found, nullptr);
    EXPECT_EQ(runtime_.get(instance, "xrGetVisibilityMaskKHR", &found), XR_ERROR_FUNCTION_UNSUPPORTED);
    EXPECT_EQ(load<PFN_xrDestroyInstance>(instance, "xrDestroyInstance")(instance), XR_SUCCESS);
}

TEST_F(DirectTest, GarbageDestroyedAndForeignHandlesAreRefused) {
    const XrInstance instance = create_instance();
    const auto get_properties = load<PFN_xrGetInstanceProperties>(instance, "xrGetInstanceProperties");
    const auto destroy = load<PFN_xrDestroyInstance>(instance, "xrDestroyInstance");
    const auto create_set = load<PFN_xrCreateActionSet>(instance, "xrCreateActionSet");
    const auto destroy_set = load<PFN_xrDestroyActionSet>(instance, "xrDestroyActionSet");
    const auto end_session = load<PFN_xrEndSession>(instance, "xrEndSession");
    XrInstanceProperties properties{};
    properties.type = XR_TYPE_INSTANCE_PROPERTIES;
    int on_stack = 0;
    for (const auto garbage : {std::uintptr_t{0}, std::uintptr_t{1}, std::uintptr_t{0xdeadbeef},
                               ~std::uintptr_t{0}, reinterpret_cast<std::uintptr_t>(&on_stack)}) {
        EXPECT_EQ(get_properties(reinterpret_cast<XrInstance>(garbage), &properties),
                  XR_ERROR_HANDLE_INVALID);
        EXPECT_EQ(end_session(reinterpret_cast<XrSession>(garbage)), XR_ERROR_HANDLE_INVALID);
    }
    EXPECT_EQ(end_session(reinterpret_cast<XrSession>(instance)), XR_ERROR_HANDLE_INVALID)
        << "of another type";

    XrActionSetCreateInfo info{};
    info.type = XR_TYPE_ACTION_SET_CREATE_INFO;
    std::strcpy(info.actionSetName, "set");
    std::strcpy(info.localizedActionSetName, "Set");
    XrActionSet set = XR_NULL_HANDLE;
    ASSERT_EQ(create_set(instance, &info, &set), XR_SUCCESS);
    EXPECT_EQ(destroy(instance), XR_SUCCESS);
    EXPECT_EQ(destroy(instance), XR_ERROR_HANDLE_INVALID);
    EXPECT_EQ(get_properties(instance, &properties), XR_ERROR_HANDLE_INVALID);
    EXPECT_EQ(destroy_set(set), XR_ERROR_HANDLE_INVALID) << "children go with their parent";
}

TEST_F(DirectTest, SeveralInstancesStandSideBySide) {
    const XrInstance a = create_instance(), b = create_instance();
    EXPECT_NE(a, b);
    const auto destroy = load<PFN_xrDestroyInstance>(a, "xrDestroyInstance");
    EXPECT_EQ(destroy(a), XR_SUCCESS);
    EXPECT_EQ(destroy(b), XR_SUCCESS);
}

TEST(EntryPoints, ExtensionsAreListedOnce) {
    set_environment({});
    std::uint32_t count = 0;
    ASSERT_XR_SUCCESS(xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr));
    XrExtensionProperties blank{};
    blank.type = XR_TYPE_EXTENSION_PROPERTIES;
    std::vector<XrExtensionProperties> list(count, blank);
    ASSERT_XR_SUCCESS(xrEnumerateInstanceExtensionProperties(nullptr, count, &count, list.data()));
    std::multiset<std::string> names;
    for (const auto& extension : list) names.insert(extension.extensionName);
    for (const char* name : all_extensions) EXPECT_EQ(names.count(name), 1u) << name;
    EXPECT_EQ(names.count(XR_KHR_VULKAN_ENABLE_EXTENSION_NAME), 1u);
}

TEST(EntryPoints, InstanceCreationVerifiesItsArguments) {
    set_environment({});
    XrInstanceCreateInfo info{};
    info.type = XR_TYPE_INSTANCE_CREATE_INFO;
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    XrInstance instance = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateInstance(&info, &instance), XR_ERROR_NAME_INVALID);
    std::strcpy(info.applicationInfo.applicationName, "test");
    const char* unknown = "XR_FOVERAY_unknown";
    info.enabledExtensionCount = 1;
    info.enabledExtensionNames = &unknown;
    EXPECT_EQ(xrCreateInstance(&info, &instance), XR_ERROR_EXTENSION_NOT_PRESENT);
    const char* alone = XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME;
    info.enabledExtensionNames = &alone;
    EXPECT_EQ(xrCreateInstance(&info, &instance), XR_ERROR_VALIDATION_FAILURE) << "needs XR_VARJO_quad_views";
}

TEST(EntryPoints, BadVariablesFailTheInstanceAndSayWhy) {
    fakes::TemporaryFolder folder;
    const std::map<std::string, std::string> cases[] = {
        {{"TIME", "fast"}},          {{"GPU", "first"}},           {{"CAPTURE_FRAMES", "5"}},
        {{"CAPTURE_FRAMES", "5:2"}}, {{"PROFILE", "no-such-one"}}, {{"SESSION", folder.path()}},
    };
    for (const auto& variables : cases) {
        set_environment(variables);
        XrInstanceCreateInfo info{};
        info.type = XR_TYPE_INSTANCE_CREATE_INFO;
        std::strcpy(info.applicationInfo.applicationName, "test");
        info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
        XrInstance instance = XR_NULL_HANDLE;
        testing::internal::CaptureStderr();
        EXPECT_NE(xrCreateInstance(&info, &instance), XR_SUCCESS) << variables.begin()->second;
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_NE(said.find(variables.begin()->second), std::string::npos) << said;
    }
}

TEST(EntryPoints, TextsAndPaths) {
    set_environment({});
    SimulatorClient client;
    char text[XR_MAX_RESULT_STRING_SIZE];
    ASSERT_XR_SUCCESS(xrResultToString(client.instance, XR_ERROR_PATH_INVALID, text));
    EXPECT_STREQ(text, "XR_ERROR_PATH_INVALID");
    ASSERT_XR_SUCCESS(xrResultToString(client.instance, static_cast<XrResult>(-12345), text));
    EXPECT_STREQ(text, "XR_UNKNOWN_FAILURE_-12345");
    ASSERT_XR_SUCCESS(xrStructureTypeToString(client.instance, XR_TYPE_FRAME_STATE, text));
    EXPECT_STREQ(text, "XR_TYPE_FRAME_STATE");

    const XrPath path = client.path("/user/hand/left");
    EXPECT_EQ(path, client.path("/user/hand/left"));
    std::uint32_t count = 0;
    char buffer[64];
    EXPECT_EQ(xrPathToString(client.instance, path, 3, &count, buffer), XR_ERROR_SIZE_INSUFFICIENT);
    EXPECT_EQ(count, 16u);
    ASSERT_XR_SUCCESS(xrPathToString(client.instance, path, sizeof buffer, &count, buffer));
    EXPECT_STREQ(buffer, "/user/hand/left");
    EXPECT_EQ(xrPathToString(client.instance, path + 100, 0, &count, nullptr), XR_ERROR_PATH_INVALID);
    XrPath ignored;
    for (const char* malformed :
         {"", "/", "user", "/User", "/user//hand", "/user/", "/user/..", "/user/a b"}) {
        EXPECT_EQ(xrStringToPath(client.instance, malformed, &ignored), XR_ERROR_PATH_FORMAT_INVALID)
            << malformed;
    }
}

}  // namespace
}  // namespace foveray::simulator_tests
