#pragma once

#include <vulkan/vulkan_raii.hpp>
