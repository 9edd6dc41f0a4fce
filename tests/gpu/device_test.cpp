#include "render/gpu/device.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/fakes/environment.h"
#include "tests/fakes/gpu_fixture.h"

namespace foveray::gpu {
namespace {

class DeviceTest : public fakes::GpuTest {};

TEST_F(DeviceTest, TellsWhatItIs) {
    EXPECT_FALSE(device().name().empty());
    EXPECT_FALSE(device().driver().empty());
    EXPECT_GE(device().limits().handle_size, 1u);
    EXPECT_GE(device().limits().max_recursion, 1u);
    EXPECT_GE(device().limits().max_instances, 1u << 16);
    EXPECT_TRUE(refusals(device().physical()).empty());
}

TEST_F(DeviceTest, AnIndexOutOfRangeIsBadInput) {
    try {
        Device other({.index = 99});
        FAIL() << "made a device";
    } catch (const Fault& fault) {
        EXPECT_EQ(fault.code(), ExitCode::BadInput);
        EXPECT_EQ(fault.where(), "--gpu 99");
        EXPECT_NE(std::string(fault.what()).find("Vulkan devices"), std::string::npos);
        EXPECT_FALSE(fault.remedy().empty());
    }
}

TEST_F(DeviceTest, NoDriverIsMissingWithARemedy) {
    const fakes::Environment none("VK_DRIVER_FILES", "/nonexistent.json"),
        old_name("VK_ICD_FILENAMES", "/nonexistent.json");
    try {
        Device other;
        FAIL() << "made a device";
    } catch (const Fault& fault) {
        EXPECT_EQ(fault.code(), ExitCode::Missing);
        EXPECT_NE(fault.remedy().find("mesa-vulkan-drivers"), std::string::npos);
    }
}

TEST_F(DeviceTest, HearsWhatIsSaidWhileTheInstanceIsMade) {
    // An extension without the one that it builds upon: the layer objects before any messenger can exist.
    const Device other(
        {.validation = true, .instance_extensions = {VK_EXT_SWAPCHAIN_COLOR_SPACE_EXTENSION_NAME}});
    const auto messages = other.validation_messages();
    ASSERT_FALSE(messages.empty());
    EXPECT_NE(messages.front().find("VK_KHR_surface"), std::string::npos) << messages.front();
}

TEST_F(DeviceTest, TakesOverWhatSomebodyElseMakes) {
    int instances = 0, choices = 0, devices = 0;
    VkInstance made = VK_NULL_HANDLE;
    DeviceSource source;
    source.create_instance = [&](PFN_vkGetInstanceProcAddr get, const VkInstanceCreateInfo& info,
                                 VkInstance* out) {
        ++instances;
        const auto create = reinterpret_cast<PFN_vkCreateInstance>(get(VK_NULL_HANDLE, "vkCreateInstance"));
        const VkResult result = create(&info, nullptr, out);
        made = *out;
        return result;
    };
    source.choose_physical_device = [&](VkInstance instance) {
        ++choices;
        const vk::raii::Context context;
        const auto get = context.getDispatcher()->vkGetInstanceProcAddr;
        const auto enumerate =
            reinterpret_cast<PFN_vkEnumeratePhysicalDevices>(get(instance, "vkEnumeratePhysicalDevices"));
        std::uint32_t count = 1;
        VkPhysicalDevice physical = VK_NULL_HANDLE;
        enumerate(instance, &count, &physical);
        return physical;
    };
    source.create_device = [&](PFN_vkGetInstanceProcAddr get, VkPhysicalDevice physical,
                               const VkDeviceCreateInfo& info, VkDevice* out) {
        ++devices;
        const auto create = reinterpret_cast<PFN_vkCreateDevice>(get(made, "vkCreateDevice"));
        return create(physical, &info, nullptr, out);
    };
    const Device other({.validation = true}, source);
    EXPECT_EQ(instances, 1);
    EXPECT_EQ(choices, 1);
    EXPECT_EQ(devices, 1);
    EXPECT_TRUE(other.validation_messages().empty());
}

}  // namespace
}  // namespace foveray::gpu
