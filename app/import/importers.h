#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "base/session.h"

namespace foveray::app {

/// A format of other tools' gaze logs that becomes a session.
struct Importer {
    std::string_view name;  // as in --from
    std::string_view help;
    /// Throws Fault(BadInput) naming file and line.
    Session (*read)(const std::vector<std::filesystem::path>& files);
};

std::span<const Importer> importers();

}  // namespace foveray::app
