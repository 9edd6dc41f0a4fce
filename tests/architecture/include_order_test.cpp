// docs/architecture.md, "Folders": an upward include fails here.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

// Longest prefix wins. Each part may include itself and the parts named with it.
const std::map<std::string, std::set<std::string>> allowed = {
    {"base", {}},
    {"shaders/shared", {}},
    {"render/gpu", {"base", "shaders/shared"}},
    {"render/scene", {"base", "shaders/shared"}},
    {"render/engine", {"base", "shaders/shared", "render/gpu", "render/scene"}},
    {"render/reference", {"base", "render/scene"}},
    {"render", {"base", "shaders/shared", "render/gpu", "render/scene", "render/engine"}},
    {"render/user_shapes",
     {"base", "shaders/shared", "render/gpu", "render/scene", "render/engine", "render"}},
    {"xr/client", {"base", "render/gpu"}},
    {"xr/simulator", {"base", "shaders/shared"}},
    {"passthrough/capture", {"base", "passthrough"}},
    {"passthrough", {"base", "shaders/shared", "render/gpu"}},
    {"app",
     {"base", "shaders/shared", "render/gpu", "render/scene", "render/engine", "render", "render/user_shapes",
      "xr/client", "passthrough", "passthrough/capture"}},
};

// Which folders may use a library's headers.
const std::vector<std::pair<std::string, std::set<std::string>>> library_homes = {
    {"opencv2/", {"passthrough/capture"}},
    {"openxr/", {"xr/client", "xr/simulator"}},
    {"tiny_gltf.h", {"render/scene"}},
    {"glslang/", {"render/user_shapes"}},
    {"GLFW/", {"app", "xr/simulator"}},
    {"imgui", {"app"}},
    {"vk_mem_alloc.h", {"render/gpu"}},
};

std::string part_of(const std::string& path) {
    std::string best;
    for (const auto& [part, unused] : allowed) {
        if (path.starts_with(part + "/") && part.size() > best.size()) best = part;
    }
    return best;
}

std::vector<std::string> includes_of(const fs::path& file) {
    static const std::regex pattern(R"(^\s*#\s*include\s+["<]([^">]+)[">])");
    std::vector<std::string> includes;
    std::ifstream in(file);
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
        if (std::regex_search(line, match, pattern)) includes.push_back(match[1]);
    }
    return includes;
}

std::vector<std::string> violations(const std::string& file, const std::vector<std::string>& includes) {
    std::vector<std::string> found;
    const std::string part = part_of(file);
    for (const std::string& include : includes) {
        const std::string target = part_of(include);
        if (!target.empty() && target != part && !allowed.at(part).contains(target)) {
            found.push_back(file + " includes " + include + ": " + part + " may not know " + target);
        }
        for (const auto& [header, homes] : library_homes) {
            if (include.starts_with(header) && !homes.contains(part)) {
                found.push_back(file + " includes " + include + ", which is not for " + part);
            }
        }
    }
    return found;
}

TEST(IncludeOrder, HoldsInTheWholeTree) {
    const fs::path root = FOVERAY_SOURCE_DIR;
    std::size_t files = 0;
    for (const char* folder : {"base", "render", "xr", "passthrough", "app", "shaders/shared"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            ++files;
            const std::string file = entry.path().lexically_relative(root).generic_string();
            for (const std::string& violation : violations(file, includes_of(entry.path()))) {
                ADD_FAILURE() << violation;
            }
        }
    }
    EXPECT_GT(files, 50u);
}

TEST(IncludeOrder, NoticesAnUpwardInclude) {
    EXPECT_TRUE(violations("base/math.cpp", {"base/math.h", "glm/glm.hpp"}).empty());
    EXPECT_EQ(violations("base/math.cpp", {"render/gpu/device.h"}).size(), 1u);
    EXPECT_EQ(violations("render/lighting.cpp", {"openxr/openxr.h"}).size(), 1u);
    EXPECT_EQ(violations("passthrough/room.cpp", {"opencv2/core.hpp"}).size(), 1u);
    EXPECT_EQ(violations("app/replay.cpp", {"xr/simulator/script/script.h"}).size(), 1u);
    EXPECT_EQ(violations("render/gpu/device.cpp", {"render/primary.h"}).size(), 1u);
}

}  // namespace
