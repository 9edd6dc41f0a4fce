// docs/architecture.md, "Changes": what the frame uses never waits for the GPU to be done with everything.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

TEST(FramePath, OnlyTheEndAndTheMirrorsWindowWaitForTheWholeDevice) {
    const std::set<std::string> may = {"render/gpu/device.cpp", "app/mirror/mirror.cpp",
                                       "app/mirror/window_swapchain.cpp"};
    const fs::path root = FOVERAY_SOURCE_DIR;
    std::set<std::string> found;
    for (const char* folder : {"app", "base", "passthrough", "render", "xr/client"}) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
            if (!entry.is_regular_file()) continue;
            std::ifstream in(entry.path());
            const std::string text(std::istreambuf_iterator<char>(in), {});
            if (text.find("waitIdle") == text.npos && text.find("WaitIdle") == text.npos) continue;
            found.insert(fs::relative(entry.path(), root).string());
        }
    }
    EXPECT_EQ(found, may);
}

}  // namespace
