#include "base/error.h"

#include <utility>

namespace foveray {

Fault::Fault(ExitCode code, std::string where, std::string what, std::string remedy)
    : std::runtime_error(where + ": " + what + (remedy.empty() ? "" : " (" + remedy + ")")),
      code_(code),
      where_(std::move(where)),
      remedy_(std::move(remedy)) {}

void throw_bad_input(std::string where, std::string what, std::string remedy) {
    throw Fault(ExitCode::BadInput, std::move(where), std::move(what), std::move(remedy));
}

void throw_missing(std::string where, std::string what, std::string remedy) {
    throw Fault(ExitCode::Missing, std::move(where), std::move(what), std::move(remedy));
}

}  // namespace foveray
