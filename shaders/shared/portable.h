// Lets one header declare structs and plain functions for C++ and GLSL. Layout: scalar, so C++'s own.
#ifndef FOVERAY_SHARED_PORTABLE_H
#define FOVERAY_SHARED_PORTABLE_H

#ifdef __cplusplus

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#define FOVERAY_SHARED_BEGIN namespace foveray::shared {
#define FOVERAY_SHARED_END }
#define FOVERAY_INLINE inline
#define FOVERAY_CONST inline constexpr

namespace foveray::shared {
using glm::mat3;
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using uvec4 = glm::uvec4;
using uint64_t = std::uint64_t;
using mat4x3 = glm::mat4x3;  // four columns of three: a 3x4 affine transform
using glm::clamp;
using glm::exp2;
using glm::floatBitsToUint;
using glm::log2;
using glm::sqrt;
using glm::max;
using glm::min;
using glm::uintBitsToFloat;
}  // namespace foveray::shared

#else

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_nonuniform_qualifier : require

#define FOVERAY_SHARED_BEGIN
#define FOVERAY_SHARED_END
#define FOVERAY_INLINE
#define FOVERAY_CONST const

// An array of T at a device address, as in MaterialArray(address).at[i].
#define FOVERAY_ARRAY(Name, T) \
    layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Name { T at[]; }

#endif

#endif
