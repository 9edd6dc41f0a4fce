#pragma once

// OpenXR's platform header needs Vulkan's types before it.
// clang-format off
#include <vulkan/vulkan.h>
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
// clang-format on
