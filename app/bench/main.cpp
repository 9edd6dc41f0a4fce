#include <iostream>

#include <CLI/CLI.hpp>

#include "app/bench/options.h"
#include "app/bench/run_bench.h"
#include "app/program.h"
#include "base/log.h"
#include "render/user_shapes/probe.h"

int main(int argc, char** argv) {
    using namespace foveray;
    if (const auto served = user_shapes::serve_probe(argc, argv)) return *served;
    return app::run_guarded(std::cerr, [&] {
        app::BenchOptions options;
        CLI::App program("Measures foveray's ray tracing on this machine's GPU.", "foveray-bench");
        app::add_bench_options(program, options);
        try {
            program.parse(argc, argv);
        } catch (const CLI::CallForHelp&) {
            std::cout << program.help();
            return ExitCode::Done;
        } catch (const CLI::ParseError& e) {
            throw_bad_input("foveray-bench", e.what(), "see `foveray-bench --help`");
        }
        log::init("info");
        return app::run_bench(options);
    });
}
