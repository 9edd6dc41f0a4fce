# Compiler settings that every target of foveray shares, as the interface target foveray_options.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

add_library(foveray_options INTERFACE)
target_include_directories(foveray_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(foveray_options INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # GCC 12 warns about its own std::string (bug 105651)
target_compile_definitions(foveray_options INTERFACE
  GLM_FORCE_RADIANS GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_ENABLE_EXPERIMENTAL
  VK_NO_PROTOTYPES VULKAN_HPP_DISPATCH_LOADER_DYNAMIC=1 VULKAN_HPP_NO_SPACESHIP_OPERATOR)

if(FOVERAY_SANITIZE)
  add_compile_options(-fsanitize=${FOVERAY_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FOVERAY_SANITIZE})
  add_compile_options(-Wno-maybe-uninitialized)  # GCC warns about its own std::regex under sanitizers
  add_compile_options(-Wno-tsan)  # fences between processes, which the thread sanitizer does not know
endif()

# foveray_library(NAME SOURCES… [PUBLIC targets…] [PRIVATE targets…])
function(foveray_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${arg_SOURCES})
  target_link_libraries(${name} PUBLIC foveray_options ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
endfunction()
