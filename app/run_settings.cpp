#include <algorithm>
#include <iostream>
#include <sstream>

#include "app/commands.h"
#include "base/headset_profile.h"
#include "base/json.h"

namespace foveray::app {
namespace {

bool is_number(const SettingInfo& info) {
    return std::holds_alternative<float Settings::*>(info.member) ||
           std::holds_alternative<int Settings::*>(info.member);
}

bool is_switch(const SettingInfo& info) { return std::holds_alternative<bool Settings::*>(info.member); }

std::string range_text(const SettingInfo& info) {
    std::ostringstream out;
    if (is_number(info)) {
        out << info.minimum << " … " << info.maximum;
    } else if (is_switch(info)) {
        out << "on, off";
    } else {
        for (std::size_t i = 0; i < info.choices.size(); ++i) out << (i ? ", " : "") << info.choices[i];
    }
    return out.str();
}

std::string default_text(const SettingInfo& info) {
    const std::string text = value_text(Settings{}, info);
    if (is_switch(info)) return text == "true" ? "on" : "off";
    return text;
}

Json setting_json(const SettingInfo& info) {
    Json json = {{"key", info.key}, {"help", info.help}};
    json["default"] = value_json(Settings{}, info);
    if (is_number(info)) {
        json["minimum"] = info.minimum;
        json["maximum"] = info.maximum;
    } else if (!is_switch(info)) {
        json["choices"] = info.choices;
    }
    return json;
}

Json headset_json(const HeadsetProfile& profile) {
    Json views = Json::array();
    for (const auto& view : profile.views) {
        views.push_back({{"eye", view.eye == Eye::Left ? "left" : "right"},
                         {"role", view.role == ViewRole::Context ? "context" : "focus"},
                         {"width", view.size.x},
                         {"height", view.size.y},
                         {"ppd", shortest(view.ppd)}});
    }
    const Acuity& acuity = profile.acuity;
    return {{"name", profile.name},
            {"display_name", profile.display_name},
            {"rate_hz", profile.rate_hz},
            {"acuity",
             {{"a", shortest(acuity.a)},
              {"b", shortest(acuity.b)},
              {"cap_ppd", shortest(acuity.cap_ppd)},
              {"outer_degrees", shortest(acuity.outer_degrees)}}},
            {"views", views}};
}

/// Columns on a terminal: bytes that start a UTF-8 character.
std::size_t columns(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

void print_table() {
    std::size_t key_width = 0, default_width = std::string_view("DEFAULT").size(), range_width = 0;
    for (const SettingInfo& info : settings_table()) {
        key_width = std::max(key_width, info.key.size());
        default_width = std::max(default_width, default_text(info).size());
        range_width = std::max(range_width, columns(range_text(info)));
    }
    const auto row = [&](std::string_view key, std::string_view value, std::string_view range,
                         std::string_view help) {
        const auto cell = [](std::string_view text, std::size_t width) {
            std::cout << text << std::string(width + 2 - columns(text), ' ');
        };
        cell(key, key_width);
        cell(value, default_width);
        cell(range, range_width);
        std::cout << help << '\n';
    };
    row("SETTING", "DEFAULT", "RANGE", "WHAT IT DOES");
    for (const SettingInfo& info : settings_table())
        row(info.key, default_text(info), range_text(info), info.help);
}

void print_headset(const HeadsetProfile& profile) {
    const Acuity& acuity = profile.acuity;
    std::cout << '\n'
              << profile.name << ": " << profile.display_name << ", " << profile.rate_hz << " Hz\n"
              << "  acuity  ppd(e) = " << acuity.a << " / (e + " << acuity.b << "), at most "
              << acuity.cap_ppd << " ppd, out to " << acuity.outer_degrees << " degrees\n";
    for (const auto& view : profile.views) {
        std::cout << "  view    " << (view.eye == Eye::Left ? "left " : "right ")
                  << (view.role == ViewRole::Context ? "context " : "focus   ") << view.size.x << " × "
                  << view.size.y << ", " << view.ppd << " ppd at the centre\n";
    }
}

}  // namespace

ExitCode run_settings(const SettingsOptions& options) {
    std::optional<HeadsetProfile> headset;
    if (options.headset) headset = read_headset_profile(*options.headset);
    if (options.json) {
        Json json = {{"settings", Json::array()}};
        for (const SettingInfo& info : settings_table()) json["settings"].push_back(setting_json(info));
        if (headset) json["headset"] = headset_json(*headset);
        std::cout << json.dump(2) << '\n';
    } else {
        print_table();
        if (headset) print_headset(*headset);
    }
    return ExitCode::Done;
}

}  // namespace foveray::app
