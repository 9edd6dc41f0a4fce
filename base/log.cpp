#include "base/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>

namespace foveray::log {

void init(const std::string& level) {
    auto logger =
        std::make_shared<spdlog::logger>("foveray", std::make_shared<spdlog::sinks::stderr_color_sink_st>());
    logger->set_pattern("%^%l%$: %v");
    logger->set_level(spdlog::level::from_str(level));
    spdlog::set_default_logger(std::move(logger));
}

}  // namespace foveray::log
