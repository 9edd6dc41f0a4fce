# Libraries from the distribution; scripts/setup.sh installs them.
find_package(Threads REQUIRED)
find_package(PNG REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Vulkan REQUIRED)
find_package(VulkanMemoryAllocator REQUIRED)
find_package(OpenXR REQUIRED)
find_package(glfw3 REQUIRED)
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)

# Debian keeps OpenCV's CMake files in the package that pulls in every module, so find the few we use by hand.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
add_library(foveray_opencv INTERFACE)
target_include_directories(foveray_opencv SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
foreach(module calib3d videoio imgcodecs imgproc core)
  find_library(OPENCV_${module} opencv_${module} REQUIRED)
  target_link_libraries(foveray_opencv INTERFACE ${OPENCV_${module}})
endforeach()

find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui REQUIRED)
find_library(IMGUI_LIBRARY imgui REQUIRED)
find_library(STB_LIBRARY stb REQUIRED)  # Debian builds Dear ImGui against it
add_library(foveray_imgui INTERFACE)
target_include_directories(foveray_imgui SYSTEM INTERFACE ${IMGUI_INCLUDE_DIR} ${IMGUI_INCLUDE_DIR}/backends)
target_link_libraries(foveray_imgui INTERFACE ${IMGUI_LIBRARY} ${STB_LIBRARY} glfw Vulkan::Vulkan ${CMAKE_DL_LIBS})
