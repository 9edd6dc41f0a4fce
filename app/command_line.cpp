#include "app/command_line.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <CLI/CLI.hpp>

#include "app/bench/options.h"
#include "app/import/importers.h"
#include "app/version.h"
#include "base/text.h"

namespace foveray::app {
namespace {

namespace fs = std::filesystem;

void add_path(CLI::App& sub, const std::string& name, std::optional<fs::path>& target,
              const std::string& help, const std::string& type) {
    sub.add_option_function<std::string>(
           name, [&target](const std::string& text) { target = text; }, help)
        ->type_name(type);
}

void add_path(CLI::App& sub, const std::string& name, fs::path& target, const std::string& help,
              const std::string& type, bool required) {
    sub.add_option_function<std::string>(
           name, [&target](const std::string& text) { target = text; }, help)
        ->type_name(type)
        ->required(required);
}

/// One of `names`, which stand for the value in --help.
void allow_only(CLI::Option& option, const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : "|") + name;
    CLI::IsMember check(names);
    check.description("");
    option.type_name(list)->check(check);
}

FrameRange parse_frame_range(const std::string& text) {
    FrameRange range;
    const char* const end = text.data() + text.size();
    const auto [colon, first_error] = std::from_chars(text.data(), end, range.first);
    if (first_error == std::errc{} && colon != end && *colon == ':') {
        const auto [last, end_error] = std::from_chars(colon + 1, end, range.end);
        if (end_error == std::errc{} && last == end && range.first < range.end) return range;
    }
    throw_bad_input("--frames " + text, "is not A:B with A below B",
                    "write --frames 0:90 for the first 90 frames");
}

void add_picture_options(CLI::App& sub, PictureOptions& options) {
    sub.add_option("--camera", options.camera, "the wearer's camera: a video file or an image sequence")
        ->type_name("SRC");
    add_path(sub, "--calibration", options.calibration, "calibration of the camera", "FILE");
    sub.add_option("--headset", options.headset, "headset profile: a name in assets/headsets, or a file")
        ->type_name("PROFILE");
    sub.add_option("--gpu", options.gpu, "Vulkan device, as `foveray doctor` counts them")->type_name("N");
    sub.add_option_function<std::vector<std::string>>(
           "--set",
           [&options](const std::vector<std::string>& assignments) {
               for (const std::string& assignment : assignments) set(options.settings, assignment);
           },
           "change a setting; may be repeated; `foveray settings` lists them")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_json(CLI::App& sub, bool& json) {
    sub.add_flag("--json", json, "print the result as JSON on standard output");
}

void add_runtime(CLI::App& sub, xr::RuntimeChoice& runtime, const std::string& help,
                 const std::vector<std::string>& names) {
    allow_only(*sub.add_option_function<std::string>(
                   "--runtime",
                   [&runtime](const std::string& name) {
                       runtime = name == "system"      ? xr::RuntimeChoice::System
                                 : name == "simulator" ? xr::RuntimeChoice::Simulator
                                                       : xr::RuntimeChoice::Auto;
                   },
                   help),
               names);
}

void add_view(CLI::App& app, ViewOptions& options) {
    CLI::App& sub = *app.add_subcommand("view", "show a scene in the headset");
    sub.footer("Example:\n  foveray view assets/scenes/demo.json --runtime simulator --mirror");
    add_path(sub, "SCENE", options.scene, ".gltf, .glb or foveray scene file", "");
    add_picture_options(sub, options);
    add_runtime(sub, options.runtime, "OpenXR runtime; auto: the system's if it answers, else the simulator",
                {"auto", "system", "simulator"});
    sub.add_flag("--mirror", options.mirror, "open a desktop window that shows what the wearer sees");
    add_path(sub, "--record", options.record, "write what happens as a session", "DIR");
}

void add_replay(CLI::App& app, ReplayOptions& options) {
    CLI::App& sub =
        *app.add_subcommand("replay", "play a recorded session on the simulated headset and report");
    sub.footer("Example:\n  foveray replay assets/sessions/demo --out out/demo --frames 0:90");
    add_path(sub, "SESSION", options.session, "session folder", "", true);
    add_path(sub, "--scene", options.scene, "scene instead of the session's", "SCENE");
    add_picture_options(sub, options);
    add_path(sub, "--out", options.out, "folder for the result; out/<session name> unless given", "DIR",
             false);
    sub.add_option_function<std::string>(
           "--frames", [&options](const std::string& text) { options.frames = parse_frame_range(text); },
           "write frames A to B - 1 only; the ones before are simulated all the same")
        ->type_name("A:B");
    add_runtime(
        sub, options.runtime,
        "system: in a worn headset, in real time; who wears it moves head and eyes, and no pictures are kept",
        {"simulator", "system"});
    sub.add_flag("--reference", options.reference, "make every viewport pixel a sample, without foveation");
    add_json(sub, options.json);
}

void add_import(CLI::App& app, ImportOptions& options) {
    CLI::App& sub = *app.add_subcommand("import", "turn another tool's gaze log into a session");
    std::string footer = "Formats:";
    std::vector<std::string> names;
    for (const Importer& importer : importers()) {
        footer += "\n  " + std::string(importer.name) + ": " + std::string(importer.help);
        names.emplace_back(importer.name);
    }
    sub.footer(footer +
               "\nExample:\n  foveray import Eye_gaze_T001.csv VR_move_T001.csv --from vive-pro-eye "
               "--out sessions/office");
    sub.add_option_function<std::vector<std::string>>(
           "FILE",
           [&options](const std::vector<std::string>& files) {
               options.files.assign(files.begin(), files.end());
           },
           "the log's files")
        ->type_name("")
        ->required();
    allow_only(*sub.add_option("--from", options.format, "format of the log")->required(), names);
    add_path(sub, "--out", options.out, "session folder to write", "SESSION", true);
    add_json(sub, options.json);
}

void add_doctor(CLI::App& app, DoctorOptions& options) {
    CLI::App& sub =
        *app.add_subcommand("doctor", "say what this machine offers, and how to get what is missing");
    sub.footer("Example:\n  foveray doctor --json");
    add_json(sub, options.json);
}

void add_settings(CLI::App& app, SettingsOptions& options) {
    CLI::App& sub = *app.add_subcommand("settings", "list the settings for --set with ranges and defaults");
    sub.footer("Example:\n  foveray settings --headset varjo-xr1");
    sub.add_option("--headset", options.headset, "show this profile's acuity figures too")
        ->type_name("PROFILE");
    add_json(sub, options.json);
}

std::string suggestion(const CLI::App& app, const std::string& unknown, bool option) {
    std::vector<std::string> names;
    if (option) {
        for (const CLI::Option* known : app.get_options()) {
            for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
        }
    } else {
        for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
            names.push_back(sub->get_name());
        }
    }
    const std::vector<std::string_view> views(names.begin(), names.end());
    return "did you mean " + std::string(nearest(unknown.substr(0, unknown.find('=')), views)) + "?";
}

/// Reports the first argument that no option or command took, if there is one.
void reject_leftovers(const CLI::App& app, const std::string& name) {
    for (const std::string& argument : app.remaining()) {
        if (argument.size() > 1 && argument.front() == '-') {
            throw_bad_input(argument, "is no option of `" + name + "`",
                            suggestion(app, argument, true) + " `" + name + " --help` lists all");
        }
    }
    for (const std::string& argument : app.remaining()) {
        if (app.get_parent() == nullptr) {
            throw_bad_input(argument, "is no command of foveray",
                            suggestion(app, argument, false) + " `foveray --help` lists all");
        }
        throw_bad_input(argument, "is one argument too many for `" + name + "`", "see `" + name + " --help`");
    }
}

}  // namespace

CommandLine parse_command_line(std::vector<std::string> arguments) {
    CommandLine line;
    ViewOptions view;
    ReplayOptions replay;
    BenchOptions bench;
    ImportOptions import;
    DoctorOptions doctor;
    SettingsOptions settings;

    CLI::App app("Foveated ray tracing for mixed-reality headsets.", "foveray");
    app.footer(
        "`foveray COMMAND --help` explains a command.\nExample:\n  foveray replay assets/sessions/demo");
    app.set_version_flag("--version", std::string("foveray ") + std::string(version));
    app.require_subcommand(1);
    add_view(app, view);
    add_replay(app, replay);
    add_bench_options(*app.add_subcommand("bench", "measure the papers' tables on this machine's GPU"),
                      bench);
    add_import(app, import);
    add_doctor(app, doctor);
    add_settings(app, settings);
    app.allow_extras();
    for (CLI::App* sub : app.get_subcommands([](CLI::App*) { return true; })) {
        sub->allow_extras();
        allow_only(*sub->add_option("--log-level", line.log_level, "how much to say on standard error"),
                   {"trace", "debug", "info", "warn", "error", "off"});
    }

    const auto used = [&]() -> const CLI::App& {
        const auto subs = app.get_subcommands();
        return subs.empty() ? app : *subs.front();
    };
    const auto used_name = [&] {
        return &used() == &app ? std::string("foveray") : "foveray " + used().get_name();
    };

    if (arguments.empty()) throw_bad_input("foveray", "needs a command", "`foveray --help` lists them");
    std::reverse(arguments.begin(), arguments.end());  // CLI11 wants the last one first
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        line.command = Notice{app.help("", CLI::AppFormatMode::Normal)};
        return line;
    } catch (const CLI::CallForVersion& e) {
        line.command = Notice{std::string(e.what()) + "\n"};
        return line;
    } catch (const CLI::ParseError& e) {
        reject_leftovers(used(), used_name());
        throw_bad_input(used_name(), one_line(e.what()), "see `" + used_name() + " --help`");
    }
    reject_leftovers(app, "foveray");
    reject_leftovers(used(), used_name());

    if (replay.out.empty())
        replay.out = fs::path("out") / fs::absolute(replay.session / ".").parent_path().filename();
    const std::string& name = used().get_name();
    if (name == "view") line.command = std::move(view);
    if (name == "replay") line.command = std::move(replay);
    if (name == "bench") line.command = std::move(bench);
    if (name == "import") line.command = std::move(import);
    if (name == "doctor") line.command = doctor;
    if (name == "settings") line.command = settings;
    return line;
}

}  // namespace foveray::app
