#include "app/program.h"

#include <cstdlib>
#include <ostream>
#include <string_view>

#include "base/text.h"

namespace foveray::app {

int run_guarded(std::ostream& errors, const std::function<ExitCode()>& program) {
    const auto report = [&errors](const std::string& message, ExitCode code) {
        errors << "foveray: error: " << one_line(message) << std::endl;
        return static_cast<int>(code);
    };
    try {
        return static_cast<int>(program());
    } catch (const Fault& fault) {
        return report(fault.what(), fault.code());
    } catch (const std::exception& e) {
        return report(std::string("internal: ") + e.what(), ExitCode::Internal);
    }
}

bool validation_wanted() {
    const char* value = std::getenv("FOVERAY_VALIDATION");
    return value && std::string_view(value) == "1";
}

}  // namespace foveray::app
