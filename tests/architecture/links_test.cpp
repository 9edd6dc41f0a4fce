// Every relative link of the README and the documentation leads somewhere.
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

TEST(Links, LeadToFilesThatExist) {
    const fs::path root = FOVERAY_SOURCE_DIR;
    std::vector<fs::path> pages = {root / "README.md", root / "assets/SOURCES.md"};
    for (const auto& entry : fs::directory_iterator(root / "docs")) {
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
    }
    const std::regex link(R"(\]\(([^)#\s]+))");
    std::size_t links = 0;
    for (const fs::path& page : pages) {
        std::stringstream text;
        text << std::ifstream(page).rdbuf();
        const std::string s =
            std::regex_replace(text.str(), std::regex(R"(```[^`]*```|`[^`]*`)"), "");  // code is no link
        for (auto it = std::sregex_iterator(s.begin(), s.end(), link); it != std::sregex_iterator(); ++it) {
            const std::string target = (*it)[1];
            if (target.find("://") != std::string::npos) continue;
            ++links;
            EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << " links to " << target;
        }
    }
    EXPECT_GT(links, 10u);
}

}  // namespace
