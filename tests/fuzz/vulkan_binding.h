#pragma once

#include <optional>

#include "tests/fuzz/caller.h"

namespace foveray::fuzz {

/// A Vulkan device for sessions, made once and kept until the program ends. Nothing where there is no Vulkan.
std::optional<XrGraphicsBindingVulkanKHR> make_vulkan_binding(const simulator_tests::DirectRuntime& runtime,
                                                              const Functions& functions);

}  // namespace foveray::fuzz
