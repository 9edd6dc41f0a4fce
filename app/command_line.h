#pragma once

#include <string>
#include <variant>
#include <vector>

#include "app/bench/table.h"
#include "app/commands.h"

namespace foveray::app {

/// --help or --version: a text for standard output, and nothing else to do.
struct Notice {
    std::string text;
};

using Command = std::variant<Notice, ViewOptions, ReplayOptions, BenchOptions, ImportOptions, DoctorOptions,
                             SettingsOptions>;

struct CommandLine {
    Command command;
    std::string log_level = "info";
};

/// `arguments` are those after the program's name. Throws Fault(BadInput) that names the argument and what
/// would have been right.
CommandLine parse_command_line(std::vector<std::string> arguments);

}  // namespace foveray::app
