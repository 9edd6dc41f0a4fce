#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/user_shape.h"
#include "render/shape_types.h"

namespace foveray::user_shapes {

/// The shaders of a shape. Throws Fault(BadInput) with the user's file and line when it does not compile.
render::UserShader compile(const scene::UserShape& shape);

/// A compute shader that calls the user's functions and looks whether they keep their word: examination.h.
std::vector<std::uint32_t> compile_examination(const scene::UserShape& shape);

}  // namespace foveray::user_shapes
