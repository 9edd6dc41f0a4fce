#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/fakes/temporary_folder.h"

namespace foveray::app {

/// A fixture with an empty folder of its own for each test.
class TemporaryFolder : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        return temporary_.write(name, text);
    }
    static std::string read(const std::filesystem::path& file) {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    }

  private:
    fakes::TemporaryFolder temporary_;

  protected:
    const std::filesystem::path folder_ = temporary_.path();
};

}  // namespace foveray::app
