# foveray_shaders(TARGET SHADERS files… [INCLUDES folders…] [ENVIRONMENT vulkan1.0] [NAMESPACE foveray::gpu]): compiles GLSL below shaders/
# to SPIR-V for that Vulkan (1.3 unless told otherwise) and embeds it in a function embedded_shaders() of that namespace, by path below
# shaders/; gpu::shader() looks there. Editing a shader or anything it includes rebuilds it.
function(foveray_shaders target)
  cmake_parse_arguments(arg "" "ENVIRONMENT;NAMESPACE" "SHADERS;INCLUDES" ${ARGN})
  if(NOT arg_ENVIRONMENT)
    set(arg_ENVIRONMENT vulkan1.3)
  endif()
  if(NOT arg_NAMESPACE)
    set(arg_NAMESPACE foveray::gpu)
  endif()
  list(TRANSFORM arg_INCLUDES PREPEND -I)
  set(table "")
  set(headers "")
  foreach(shader ${arg_SHADERS})
    string(MAKE_C_IDENTIFIER ${shader} symbol)
    set(source ${CMAKE_SOURCE_DIR}/shaders/${shader})
    set(header ${CMAKE_CURRENT_BINARY_DIR}/spirv/${symbol}.h)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${GLSLANG_VALIDATOR} --target-env ${arg_ENVIRONMENT} -g0 -I${CMAKE_SOURCE_DIR} -I${CMAKE_SOURCE_DIR}/shaders ${arg_INCLUDES}
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
namespace @arg_NAMESPACE@ {

std::span<const std::pair<std::string_view, std::span<const std::uint32_t>>> embedded_shaders() {
    static const std::pair<std::string_view, std::span<const std::uint32_t>> table[] = {
@table@    };
    return table;
}

}  // namespace @arg_NAMESPACE@
")
  add_library(${target} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${target}_table.cpp ${headers})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
  target_compile_features(${target} PRIVATE cxx_std_20)
endfunction()
