#include <algorithm>
#include <cstring>

#include "app/doctor/finding.h"
#include "render/gpu/device.h"

namespace foveray::app {
namespace {

using State = Finding::State;

constexpr const char* driver_remedy =
    "the GPU maker's driver, or for the CPU Mesa 25: apt-get install mesa-vulkan-drivers (on Debian 12 after "
    "adding "
    "bookworm-backports, with -t bookworm-backports)";

std::string version_text(std::uint32_t v) {
    return std::to_string(VK_API_VERSION_MAJOR(v)) + "." + std::to_string(VK_API_VERSION_MINOR(v)) + "." +
           std::to_string(VK_API_VERSION_PATCH(v));
}

Finding find_validation(const vk::raii::Context& context) {
    constexpr const char* name = "VK_LAYER_KHRONOS_validation";
    for (const auto& layer : context.enumerateInstanceLayerProperties()) {
        if (std::strcmp(layer.layerName, name) != 0) continue;
        return {State::Good, "Vulkan validation layer", version_text(layer.specVersion), ""};
    }
    return {State::Optional, "Vulkan validation layer", "not installed; only the tests need it",
            "apt-get install vulkan-validationlayers"};
}

Finding describe(const vk::raii::PhysicalDevice& physical, std::size_t index) {
    const auto properties =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& device = properties.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = properties.get<vk::PhysicalDeviceDriverProperties>();
    Finding finding{State::Good, "Vulkan device " + std::to_string(index),
                    std::string(device.deviceName.data()) + ", " + driver.driverName.data() + " " +
                        driver.driverInfo.data() + ", Vulkan " + version_text(device.apiVersion),
                    ""};
    const std::vector<std::string> reasons = gpu::refusals(physical);
    if (reasons.empty()) {
        finding.what += ", ray-tracing pipelines";
        return finding;
    }
    finding.state = State::Note;
    finding.what += ", cannot be used: lacks";
    for (const std::string& reason : reasons) finding.what += " " + reason;
    return finding;
}

}  // namespace

std::vector<Finding> find_vulkan() {
    std::vector<Finding> findings;
    try {
        const vk::raii::Context context;
        findings.push_back(
            {State::Good, "Vulkan loader", version_text(context.enumerateInstanceVersion()), ""});
        findings.push_back(find_validation(context));
        const vk::ApplicationInfo application("foveray", 0, nullptr, 0, VK_API_VERSION_1_3);
        const vk::raii::Instance instance(context, vk::InstanceCreateInfo({}, &application));
        std::size_t index = 0;
        for (const auto& physical : instance.enumeratePhysicalDevices()) {
            findings.push_back(describe(physical, index++));
        }
    } catch (const vk::SystemError& e) {
        findings.push_back({State::Note, "Vulkan", e.what(), ""});
    } catch (const std::runtime_error& e) {  // the loader is not there
        findings.push_back({State::Missing, "Vulkan loader", e.what(), "apt-get install libvulkan1"});
    }
    const bool usable = std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
        return f.state == State::Good && f.subject.starts_with("Vulkan device");
    });
    if (!usable) {
        findings.push_back(
            {State::Missing, "Ray tracing", "no Vulkan device has ray-tracing pipelines", driver_remedy});
    }
    return findings;
}

}  // namespace foveray::app
