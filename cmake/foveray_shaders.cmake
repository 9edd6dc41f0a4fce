# foveray_shaders(TARGET SHADERS files… [INCLUDES folders…]): compiles GLSL below shaders/ to SPIR-V and embeds it; gpu::shader() finds it
# by its path below shaders/. Editing a shader or anything it includes rebuilds it.
function(foveray_shaders target)
  cmake_parse_arguments(arg "" "" "SHADERS;INCLUDES" ${ARGN})
  list(TRANSFORM arg_INCLUDES PREPEND -I)
  set(table "")
  set(headers "")
  foreach(shader ${arg_SHADERS})
    string(MAKE_C_IDENTIFIER ${shader} symbol)
    set(source ${CMAKE_SOURCE_DIR}/shaders/${shader})
    set(header ${CMAKE_CURRENT_BINARY_DIR}/spirv/${symbol}.h)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${GLSLANG_VALIDATOR} --target-env vulkan1.3 -g0 -I${CMAKE_SOURCE_DIR} -I${CMAKE_SOURCE_DIR}/shaders ${arg_INCLUDES}
              --depfile ${header}.d --vn ${symbol} -o ${header} ${source}
      DEPENDS ${source}
      DEPFILE ${header}.d
      COMMENT "Compiling ${shader}"
      VERBATIM)
    list(APPEND headers ${header})
    string(APPEND includes "#include \"spirv/${symbol}.h\"\n")
    string(APPEND table "    {\"${shader}\", ${symbol}},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${target}_table.cpp @ONLY CONTENT
"#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

@includes@
namespace foveray::gpu {

std::span<const std::pair<std::string_view, std::span<const std::uint32_t>>> embedded_shaders() {
    static const std::pair<std::string_view, std::span<const std::uint32_t>> table[] = {
@table@    };
    return table;
}

}  // namespace foveray::gpu
")
  add_library(${target} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${target}_table.cpp ${headers})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
  target_compile_features(${target} PRIVATE cxx_std_20)
endfunction()
