#pragma once

#include <stdexcept>
#include <string>

namespace foveray {

enum class ExitCode : int {
    Done = 0,
    Difference = 1,  // ran, and found a difference
    BadInput = 2,    // arguments or files
    Missing = 3,     // the machine lacks something; `foveray doctor` says what
    Internal = 4,
    Interrupted = 130,  // by Ctrl-C, as shells have it
};

/// A fault in the world: a file, a device, an argument. A bug in foveray is an assert instead, and an
/// expected outcome a return value.
class Fault : public std::runtime_error {
  public:
    /// where: "file:line", "file: /path/in/json" or the name of a device or argument.
    /// what: one sentence. remedy: what the user can do.
    Fault(ExitCode code, std::string where, std::string what, std::string remedy);

    ExitCode code() const { return code_; }
    const std::string& where() const { return where_; }
    const std::string& remedy() const { return remedy_; }

  private:
    ExitCode code_;
    std::string where_, remedy_;
};

[[noreturn]] void throw_bad_input(std::string where, std::string what, std::string remedy);
[[noreturn]] void throw_missing(std::string where, std::string what, std::string remedy);

}  // namespace foveray
