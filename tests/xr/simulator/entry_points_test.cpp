// The library itself: negotiation, function lookup, handles, and what every call refuses.
#include <algorithm>
#include <cstring>
#include <set>

#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/direct_runtime.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

TEST(EntryPoints, NegotiationStatesVersionsAndRefusesStrangers) {
    DirectRuntime runtime;
    LoaderInfo loader;
    RuntimeRequest request;
    ASSERT_EQ(runtime.negotiate(&loader, &request), XR_SUCCESS);
    EXPECT_EQ(request.interface, 1u);
    EXPECT_EQ(XR_VERSION_MAJOR(request.api), 1u);
    EXPECT_EQ(XR_VERSION_MINOR(request.api), XR_VERSION_MINOR(XR_CURRENT_API_VERSION));
    EXPECT_EQ(runtime.negotiate(nullptr, &request), XR_ERROR_INITIALIZATION_FAILED);
    EXPECT_EQ(runtime.negotiate(&loader, nullptr), XR_ERROR_INITIALIZATION_FAILED);
    LoaderInfo future;
    future.min_interface = future.max_interface = 2;
    EXPECT_EQ(runtime.negotiate(&future, &request), XR_ERROR_INITIALIZATION_FAILED);
    LoaderInfo wrong_size;
    wrong_size.size = 4;
    EXPECT_EQ(runtime.negotiate(&wrong_size, &request), XR_ERROR_INITIALIZATION_FAILED);
}

TEST(EntryPoints, OnlyNegotiationIsExported) {
    DirectRuntime runtime;
    EXPECT_EQ(runtime.symbol("xrCreateInstance"), nullptr);
    EXPECT_EQ(runtime.symbol("xrGetInstanceProcAddr"), nullptr);
}

TEST(EntryPoints, FunctionsNeedTheirInstanceAndExtension) {
    set_environment({});
    DirectRuntime runtime;
    PFN_xrVoidFunction found = nullptr;
    EXPECT_EQ(runtime.get_proc_addr(XR_NULL_HANDLE, "xrGetSystem", &found), XR_ERROR_HANDLE_INVALID);
    EXPECT_EQ(runtime.get_proc_addr(XR_NULL_HANDLE, "xrCreateInstance", nullptr),
              XR_ERROR_VALIDATION_FAILURE);
    const XrInstance instance = runtime.create_instance({});
    EXPECT_EQ(runtime.get_proc_addr(instance, "xrGetSystem", &found), XR_SUCCESS);
    EXPECT_EQ(runtime.get_proc_addr(instance, "xrNoSuchFunction", &found), XR_ERROR_FUNCTION_UNSUPPORTED);
    EXPECT_EQ(found, nullptr);
    EXPECT_EQ(runtime.get_proc_addr(instance, "xrGetVisibilityMaskKHR", &found),
              XR_ERROR_FUNCTION_UNSUPPORTED);
    EXPECT_EQ(runtime.load<PFN_xrDestroyInstance>(instance, "xrDestroyInstance")(instance), XR_SUCCESS);
}

TEST(EntryPoints, SeveralInstancesStandSideBySide) {
    set_environment({});
    DirectRuntime runtime;
    const XrInstance a = runtime.create_instance({}), b = runtime.create_instance({});
    EXPECT_NE(a, b);
    const auto destroy = runtime.load<PFN_xrDestroyInstance>(a, "xrDestroyInstance");
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

TEST(EntryPoints, QuadViewsAreOfferedForFocusDisplaysOnly) {
    for (const auto& [profile, has_focus] :
         {std::pair{"ci", true}, {"varjo-xr1", true}, {"quest-pro", false}}) {
        set_environment({{"PROFILE", profile}});
        const auto offered = offered_extensions();
        for (const std::string name :
             {XR_VARJO_QUAD_VIEWS_EXTENSION_NAME, XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME}) {
            EXPECT_EQ(std::ranges::count(offered, name), has_focus ? 1 : 0) << profile << ' ' << name;
        }
    }
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
#ifdef XR_VERSION_1_1
    constexpr auto needs_quad_views = XR_ERROR_EXTENSION_DEPENDENCY_NOT_ENABLED;
#else
    constexpr auto needs_quad_views = XR_ERROR_VALIDATION_FAILURE;
#endif
    EXPECT_EQ(xrCreateInstance(&info, &instance), needs_quad_views);
}

TEST(EntryPoints, BadVariablesFailTheInstanceAndSayWhy) {
    fakes::TemporaryFolder folder;
    const std::map<std::string, std::string> cases[] = {
        {{"TIME", "fast"}},
        {{"GPU", "first"}},
        {{"CAPTURE_FRAMES", "5"}},
        {{"CAPTURE_FRAMES", "5:2"}},
        {{"PROFILE", "no-such-one"}},
        {{"SESSION", folder.path()}},
        {{"CAPTURE_FORMAT", "bmp"}},
        {{"BACKGROUND", "#12345"}},
        {{"BACKGROUND", "#12345g"}},
        {{"BACKGROUND", "no/such/file.hdr"}},
        {{"BACKGROUND", "no/such/*.png"}},
        {{"BACKGROUND", folder.path()}},
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
