#include "app/mirror/panel.h"

#include <algorithm>
#include <string>

#include <imgui.h>

namespace foveray::app {
namespace {

const char* gaze_text(GazeSource source) {
    switch (source) {
        case GazeSource::Eyes:
            return "gaze from the eye tracker";
        case GazeSource::Mouse:
            return "gaze from the mouse";
        case GazeSource::Nothing:
            return "no gaze: move the mouse over the picture";
    }
    return "";
}

void draw_times(const TimeHistory& history, const FrameMetrics& newest) {
    float top = 1.0f;
    for (std::size_t i = 0; i < history.size(); ++i)
        top = std::max({top, history.gpu_ms(i), history.cpu_ms(i)});
    const auto plot = [&](const char* name, auto value) {
        struct Context {
            const TimeHistory& history;
            decltype(value) get;
        } context{history, value};
        const float last = history.size() ? value(history, history.size() - 1) : 0.0f;
        ImGui::Text("%s %.2f ms", name, static_cast<double>(last));
        ImGui::PlotLines((std::string("##") + name).c_str(),
                         [](void* data, int i) {
                             const auto& c = *static_cast<Context*>(data);
                             return c.get(c.history, static_cast<std::size_t>(i));
                         },
                         &context, static_cast<int>(history.size()), 0, nullptr, 0.0f, top,
                         {ImGui::GetContentRegionAvail().x, 44});
    };
    plot("GPU", [](const TimeHistory& h, std::size_t i) { return h.gpu_ms(i); });
    plot("CPU", [](const TimeHistory& h, std::size_t i) { return h.cpu_ms(i); });

    const double total = std::max(newest.gpu_ms(), 1e-6);
    for (const auto& [name, ms] : newest.stages) {
        char text[32];
        std::snprintf(text, sizeof text, "%.2f ms", ms);
        ImGui::ProgressBar(static_cast<float>(ms / total), {130, 0}, text);
        ImGui::SameLine();
        ImGui::TextUnformatted(name.c_str());
    }
    ImGui::TextDisabled("%llu rays, polar image %u x %u",
                        static_cast<unsigned long long>(newest.rays.total()), newest.polar_size.x,
                        newest.polar_size.y);
}

/// One setting's widget; the label is the key without its group.
void draw_setting(Settings& settings, const SettingInfo& info, const std::string& label) {
    const auto low = static_cast<float>(info.minimum), high = static_cast<float>(info.maximum);
    if (const auto* f = std::get_if<float Settings::*>(&info.member)) {
        // Ranges over several magnitudes get a slider to match.
        const bool wide = low >= 0.0f && high > 50.0f * std::max(low, 1.0f);
        const ImGuiSliderFlags flags =
            ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
        float& value = settings.*(*f);
        const bool by_name = value == 0.0f && !info.zero.empty();
        ImGui::SliderFloat(label.c_str(), &value, low, high,
                           by_name ? std::string(info.zero).c_str() : "%.3g", flags);
    } else if (const auto* i = std::get_if<int Settings::*>(&info.member)) {
        ImGui::SliderInt(label.c_str(), &(settings.*(*i)), static_cast<int>(low), static_cast<int>(high),
                         "%d", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    } else if (const auto* b = std::get_if<bool Settings::*>(&info.member)) {
        ImGui::Checkbox(label.c_str(), &(settings.*(*b)));
    } else {
        std::string& value = settings.*std::get<std::string Settings::*>(info.member);
        if (ImGui::BeginCombo(label.c_str(), value.c_str())) {
            for (const std::string_view choice : info.choices) {
                if (ImGui::Selectable(std::string(choice).c_str(), choice == value)) value = choice;
            }
            ImGui::EndCombo();
        }
    }
    if (ImGui::IsItemHovered()) {
        const std::string help(info.help), usual = value_text(Settings{}, info);
        ImGui::SetTooltip("%s\ndefault: %s", help.c_str(), usual.c_str());
    }
}

void draw_settings(Settings& settings) {
    ImGui::PushItemWidth(140);
    std::string_view group;
    bool open = false;
    for (const SettingInfo& info : settings_table()) {
        const std::size_t dot = info.key.find('.');
        if (info.key.substr(0, dot) != group) {
            group = info.key.substr(0, dot);
            open = ImGui::CollapsingHeader(std::string(group).c_str(), ImGuiTreeNodeFlags_DefaultOpen);
        }
        if (!open) continue;
        std::string label(info.key.substr(dot + 1));
        std::replace(label.begin(), label.end(), '_', ' ');
        draw_setting(settings, info, label + "##" + std::string(group));
    }
    ImGui::PopItemWidth();
    if (ImGui::Button("all to their defaults")) settings = Settings{};
}

}  // namespace

void TimeHistory::add(const FrameMetrics& metrics) {
    gpu_[next_] = static_cast<float>(metrics.gpu_ms());
    cpu_[next_] = static_cast<float>(metrics.cpu_ms);
    next_ = (next_ + 1) % length;
    size_ = std::min(size_ + 1, length);
}

void draw_panel(MirrorState& state, Settings& settings, const TimeHistory& history,
                const FrameMetrics& newest, GazeSource gaze) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x - panel_width, 0});
    ImGui::SetNextWindowSize({panel_width, display.y});
    ImGui::Begin("foveray", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    ImGui::RadioButton("left eye", &state.eye, 0);
    ImGui::SameLine();
    ImGui::RadioButton("right eye", &state.eye, 1);
    ImGui::SameLine();
    ImGui::Checkbox("gaze mark", &state.show_mark);
    ImGui::TextDisabled("%s", gaze_text(gaze));
    ImGui::Separator();
    draw_times(history, newest);
    ImGui::Separator();
    const float keys_height = ImGui::GetTextLineHeightWithSpacing() + 6;
    ImGui::BeginChild("settings", {0, -keys_height});
    draw_settings(settings);
    ImGui::EndChild();
    ImGui::Separator();
    ImGui::TextDisabled("E other eye   G gaze mark   Tab panel   Esc quit");
    ImGui::End();
}

}  // namespace foveray::app
