#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "app/commands.h"

namespace foveray::app {

/// --help or --version: a text for standard output, and nothing else to do.
struct Notice {
    std::string text;
};

using Command =
    std::variant<Notice, ViewOptions, ReplayOptions, ImportOptions, DoctorOptions, SettingsOptions>;

struct CommandLine {
    Command command;
    std::string log_level = "info";
};

/// `arguments` are those after the program's name. Throws Fault(BadInput) that names the argument and what
/// would have been right.
CommandLine parse_command_line(std::vector<std::string> arguments);

/// Runs `program` and turns what it throws into one line on `errors` and an exit code; every error of foveray
/// ends here.
int run_guarded(std::ostream& errors, const std::function<ExitCode()>& program);

}  // namespace foveray::app
