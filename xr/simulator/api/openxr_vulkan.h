#pragma once

// OpenXR's platform header needs the types of Vulkan and of <time.h> before it.
// clang-format off
#include <ctime>
#include <vulkan/vulkan.h>
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
// clang-format on
