include(GoogleTest)
find_package(GTest REQUIRED)

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
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
    PROPERTIES ENVIRONMENT "FOVERAY_ASSETS=${CMAKE_SOURCE_DIR}/assets" TIMEOUT ${arg_TIMEOUT}
    LABELS "${labels}")
endfunction()
