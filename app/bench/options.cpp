#include "app/bench/options.h"

#include <CLI/CLI.hpp>

namespace foveray::app {

void add_bench_options(CLI::App& app, BenchOptions& options) {
    std::string footer = "Tables:";
    std::vector<std::string> names;
    for (const BenchTable& table : bench_tables()) {
        footer += "\n  " + table.name + ": " + table.help;
        names.push_back(table.name);
    }
    app.footer(footer);
    CLI::IsMember known(names);
    known.description("");
    app.add_option("TABLE", options.tables, "tables to measure; all unless given")
        ->type_name("")
        ->check(known);
    app.add_option_function<std::string>(
           "--out", [&options](const std::string& text) { options.out = text; },
           "folder for bench.json and a picture of each row")
        ->type_name("DIR");
    app.add_option("--rows", options.rows, "only rows whose name has this text in it")->type_name("TEXT");
    app.add_option("--set", options.assignments,
                   "change a setting of all rows; `foveray settings` lists them")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--seconds", options.seconds, "how long each row is measured")
        ->type_name("S")
        ->check(CLI::Range(0.1, 600.0).description(""));
    app.add_option("--gpu", options.gpu, "Vulkan device, as `foveray doctor` counts them")->type_name("N");
    app.add_flag("--quick", options.quick, "a sixteenth of the pixels and three frames: does it run at all?");
    app.add_flag("--json", options.json, "print the result as JSON on standard output");
}

}  // namespace foveray::app
