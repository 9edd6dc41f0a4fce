#include <iostream>

#include "app/bench/run_bench.h"
#include "app/command_line.h"
#include "app/program.h"
#include "base/log.h"
#include "render/user_shapes/probe.h"

namespace foveray::app {
namespace {

struct Run {
    ExitCode operator()(const Notice& notice) const {
        std::cout << notice.text;
        return ExitCode::Done;
    }
    ExitCode operator()(const ViewOptions& options) const { return run_view(options); }
    ExitCode operator()(const ReplayOptions& options) const { return run_replay(options); }
    ExitCode operator()(const BenchOptions& options) const { return run_bench(options); }
    ExitCode operator()(const ImportOptions& options) const { return run_import(options); }
    ExitCode operator()(const DoctorOptions& options) const { return run_doctor(options); }
    ExitCode operator()(const SettingsOptions& options) const { return run_settings(options); }
};

}  // namespace
}  // namespace foveray::app

int main(int argc, char** argv) {
    using namespace foveray;
    if (const auto served = user_shapes::serve_probe(argc, argv)) return *served;
    return app::run_guarded(std::cerr, [&] {
        const app::CommandLine line = app::parse_command_line({argv + 1, argv + argc});
        log::init(line.log_level);
        return std::visit(app::Run{}, line.command);
    });
}
