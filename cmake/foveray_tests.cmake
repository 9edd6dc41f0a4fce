include(GoogleTest)
find_package(GTest REQUIRED)

if(FOVERAY_SANITIZE)
  add_library(foveray_sanitizers OBJECT ${CMAKE_SOURCE_DIR}/tests/fakes/sanitizers.cpp)
  target_link_libraries(foveray_sanitizers PRIVATE foveray_options)
endif()

# foveray_test(NAME SOURCES … LIBRARIES … [LABELS …] [TIMEOUT seconds]): one program, one ctest entry a test case.
# Tests that need Vulkan run with the validation layers on; see tests/fakes/gpu_fixture.h.
function(foveray_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  list(JOIN arg_LABELS "\\;" labels)  # gtest_discover_tests would take a list apart
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE foveray_options ${arg_LIBRARIES} GTest::gtest_main)
  if(FOVERAY_SANITIZE)
    target_sources(${name} PRIVATE $<TARGET_OBJECTS:foveray_sanitizers>)
    set_target_properties(${name} PROPERTIES ENABLE_EXPORTS ON)  # other libraries shall find its dlclose
    math(EXPR arg_TIMEOUT "10 * ${arg_TIMEOUT}")
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
    PROPERTIES ENVIRONMENT "FOVERAY_ASSETS=${CMAKE_SOURCE_DIR}/assets" TIMEOUT ${arg_TIMEOUT}
    LABELS "${labels}")
endfunction()
