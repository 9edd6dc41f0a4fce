#include "xr/simulator/script/faults.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "base/csv.h"
#include "base/error.h"
#include "xr/simulator/api/names.h"
#include "xr/simulator/api/return_codes.h"
#include "xr/simulator/options.h"

namespace foveray::simulator {
namespace {

enum class ValueKind { None, Seconds, Milliseconds, Count, Function, Call };

struct FaultName {
    std::string_view name;
    FaultKind kind;
    ValueKind value = ValueKind::None;
};

constexpr FaultName fault_names[] = {
    {"exit", FaultKind::Exit},
    {"session_pause", FaultKind::SessionPause},
    {"session_loss", FaultKind::SessionLoss},
    {"loss_pending", FaultKind::SessionLossPending, ValueKind::Seconds},
    {"instance_loss", FaultKind::InstanceLoss},
    {"instance_loss_pending", FaultKind::InstanceLossPending, ValueKind::Seconds},
    {"recenter", FaultKind::Recentre},
    {"focus_lost", FaultKind::FocusLost},
    {"focus_gained", FaultKind::FocusGained},
    {"visibility_lost", FaultKind::VisibilityLost},
    {"visibility_gained", FaultKind::VisibilityGained},
    {"user_absent", FaultKind::UserAbsent},
    {"user_present", FaultKind::UserPresent},
    {"head_tracking_lost", FaultKind::HeadTrackingLost},
    {"head_tracking_gained", FaultKind::HeadTrackingGained},
    {"position_tracking_lost", FaultKind::PositionTrackingLost},
    {"position_tracking_gained", FaultKind::PositionTrackingGained},
    {"orientation_tracking_lost", FaultKind::OrientationTrackingLost},
    {"orientation_tracking_gained", FaultKind::OrientationTrackingGained},
    {"gaze_tracking_lost", FaultKind::GazeTrackingLost},
    {"gaze_tracking_gained", FaultKind::GazeTrackingGained},
    {"form_factor_lost", FaultKind::FormFactorLost},
    {"form_factor_gained", FaultKind::FormFactorGained},
    {"visibility_mask_removed", FaultKind::MaskRemoved},
    {"visibility_mask_restored", FaultKind::MaskRestored},
    {"slow_compositor", FaultKind::SlowCompositor, ValueKind::Milliseconds},
    {"swapchain_timeout", FaultKind::SwapchainTimeout, ValueKind::Count},
    {"out_of_memory", FaultKind::FailingCall, ValueKind::Function},
    {"fail", FaultKind::FailingCall, ValueKind::Call},
};

bool is_instance_loss(FaultKind kind) {
    return kind == FaultKind::InstanceLoss || kind == FaultKind::InstanceLossPending;
}

const FaultName* find_fault_name(std::string_view name) {
    const auto found = std::ranges::find(fault_names, name, &FaultName::name);
    return found != std::end(fault_names) ? &*found : nullptr;
}

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// A span of at most a year, in units of so many seconds.
std::optional<Nanoseconds> parse_span(std::string_view text, double unit) {
    constexpr double longest = 366.0 * 24 * 3600;  // seconds
    const auto number = parse_number<double>(text);
    if (!number || !(*number >= 0.0 && *number * unit <= longest)) return std::nullopt;
    return from_seconds(*number * unit);
}

/// Takes " x3" or " always" off the end of `text`.
std::uint32_t take_times(std::string_view& text, const std::string& where) {
    const std::size_t space = text.find(' ');
    if (space == std::string_view::npos) return 1;
    const std::string_view times = text.substr(text.find_last_of(' ') + 1);
    text = text.substr(0, space);
    if (times == "always") return FailingCall::always;
    const auto count = times.starts_with('x') ? parse_number<std::uint32_t>(times.substr(1)) : std::nullopt;
    if (!count || *count == 0 || *count == FailingCall::always)
        throw_bad_input(where, quoted(times) + " is no number of calls", "write x3 for three, or always");
    return *count;
}

const FunctionEntry& read_function(std::string_view name, const std::string& where) {
    const FunctionEntry* const function = find_function(name);
    if (!function)
        throw_bad_input(where, quoted(name) + " is no function of this runtime",
                        "use the name of an OpenXR function, such as xrEndFrame");
    return *function;
}

/// xrFunction=XR_ERROR_NAME, or the function alone where the error is given.
FailingCall parse_call(std::string_view text, std::optional<XrResult> given, const std::string& where) {
    FailingCall call;
    call.times = take_times(text, where);
    const std::size_t equals = text.find('=');
    if (!given && equals == std::string_view::npos)
        throw_bad_input(where, quoted(text) + " names no error",
                        "write xrFunction=XR_ERROR_NAME, such as xrEndFrame=XR_ERROR_RUNTIME_FAILURE");
    call.function = &read_function(given ? text : text.substr(0, equals), where);
    const std::string_view code = given ? name_of(*given) : text.substr(equals + 1);
    const auto error = result_of_name(code);
    if (!error) throw_bad_input(where, quoted(code) + " is no result of OpenXR", "check its spelling");
    if (!may_answer(*call.function, *error)) {
        std::string allowed;
        for (const std::string_view own : error_codes(*call.function))
            allowed += (allowed.empty() ? "XR_ERROR_" : ", XR_ERROR_") + std::string(own);
        throw_bad_input(where,
                        std::string(call.function->name) + " may not answer " + std::string(code) +
                            " by the specification",
                        "use one of " + allowed);
    }
    call.error = *error;
    return call;
}

/// A frame (12), a session time (0.4s, 400ms), or `start`.
Nanoseconds parse_time(std::string_view text, Nanoseconds frame_period, const std::string& where) {
    if (text == "start") return ScriptedFault::start;
    constexpr std::uint64_t last_frame = 10'000'000;  // as in sessions
    if (const auto frame = parse_number<std::uint64_t>(text); frame && *frame <= last_frame)
        return static_cast<Nanoseconds>(*frame) * frame_period;
    std::optional<Nanoseconds> time;
    if (text.ends_with("ms")) {
        time = parse_span(text.substr(0, text.size() - 2), 1e-3);
    } else if (text.ends_with('s')) {
        time = parse_span(text.substr(0, text.size() - 1), 1.0);
    }
    if (!time)
        throw_bad_input(where, quoted(text) + " is no frame or time",
                        "write a frame (12), a time with its unit (0.4s, 400ms), or start");
    return *time;
}

}  // namespace

bool is_of_session(FaultKind kind) {
    return kind == FaultKind::Exit || kind == FaultKind::SessionPause || kind == FaultKind::SessionLoss ||
           kind == FaultKind::SessionLossPending || kind == FaultKind::Recentre;
}

bool is_of_instance(FaultKind kind) {
    return is_instance_loss(kind) || kind == FaultKind::SwapchainTimeout || kind == FaultKind::FailingCall;
}

bool is_fault_name(std::string_view name) { return find_fault_name(name); }

bool takes_value(std::string_view name) {
    const FaultName* const known = find_fault_name(name);
    return known && known->value != ValueKind::None;
}

ScriptedFault parse_fault(Nanoseconds time, std::string_view name, std::string_view value,
                          const std::string& where) {
    const FaultName* const known = find_fault_name(name);
    if (!known) throw_bad_input(where, quoted(name) + " is no fault", "docs/simulator.md lists them");
    ScriptedFault fault;
    fault.kind = known->kind;
    fault.time = is_of_session(fault.kind) ? std::max<Nanoseconds>(time, 0) : time;
    if (time == ScriptedFault::start && is_instance_loss(fault.kind))
        throw_bad_input(where, "the instance cannot be lost before it is made", "use frame 0");
    const auto need = [&](bool good, const std::string& remedy) {
        if (!good) throw_bad_input(where, quoted(value) + " is no value for " + std::string(name), remedy);
    };
    const auto read_span = [&](double unit, const std::string& remedy) {
        const auto span = parse_span(value, unit);
        need(span.has_value(), remedy);
        fault.span = *span;
    };
    switch (known->value) {
        case ValueKind::None:
            need(value.empty(), "leave it empty");
            break;
        case ValueKind::Seconds:
            read_span(1.0, "give the seconds until the loss, such as 0.5");
            break;
        case ValueKind::Milliseconds:
            read_span(1e-3, "give the milliseconds that it takes for a frame, 0 to end it");
            break;
        case ValueKind::Count: {
            const auto count = parse_number<std::uint32_t>(value);
            need(count && *count > 0, "give how many waits run out of time");
            fault.count = *count;
            break;
        }
        case ValueKind::Function:
            fault.call = parse_call(value, XR_ERROR_OUT_OF_MEMORY, where);
            break;
        case ValueKind::Call:
            fault.call = parse_call(value, std::nullopt, where);
            break;
    }
    return fault;
}

std::vector<ScriptedFault> read_faults(const std::filesystem::path& file, Nanoseconds frame_period) {
    const CsvTable table = CsvTable::read(file);
    const std::size_t at = table.column("at"), name = table.column("fault"), value = table.column("value");
    std::vector<ScriptedFault> faults;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const std::string where = table.where(row);
        faults.push_back(parse_fault(parse_time(table.text(row, at), frame_period, where),
                                     table.text(row, name), table.text(row, value), where));
    }
    return faults;
}

void arm_failures_from_start() {
    static std::mutex mutex;
    static std::filesystem::path armed;
    const std::lock_guard lock(mutex);
    const std::filesystem::path file = faults_file();
    if (file == armed) return;
    armed = file;
    if (file.empty()) return;
    try {
        for (const ScriptedFault& fault : read_faults(file, 1)) {
            if (fault.kind == FaultKind::FailingCall && fault.time == ScriptedFault::start &&
                fault.call.function->owner == Owner::None)
                failing_calls_of_process().add(fault.call);
        }
    } catch (const Fault&) {
        // xrCreateInstance reads the file again, and tells.
    }
}

Faults::Faults(std::vector<ScriptedFault> faults) : faults_(std::move(faults)) {
    std::ranges::stable_sort(faults_, {}, &ScriptedFault::time);
}

void Faults::add(const ScriptedFault& fault) {
    const std::lock_guard lock(mutex_);
    faults_.insert(std::ranges::upper_bound(faults_, fault.time, {}, &ScriptedFault::time), fault);
}

Condition Faults::at(Nanoseconds time) const {
    const std::lock_guard lock(mutex_);
    Condition now;
    // A loss that goes on keeps its time.
    const auto lose = [](std::optional<Nanoseconds>& since, Nanoseconds when) {
        if (!since) since = when;
    };
    for (const ScriptedFault& fault : faults_) {
        if (fault.time > time) break;
        switch (fault.kind) {
            case FaultKind::FocusLost:
            case FaultKind::FocusGained:
                now.focused = fault.kind == FaultKind::FocusGained;
                break;
            case FaultKind::VisibilityLost:
            case FaultKind::VisibilityGained:
                now.visible = fault.kind == FaultKind::VisibilityGained;
                break;
            case FaultKind::UserAbsent:
            case FaultKind::UserPresent:
                now.user_present = fault.kind == FaultKind::UserPresent;
                break;
            case FaultKind::HeadTrackingLost:
            case FaultKind::HeadTrackingGained:
                now.head_tracked = fault.kind == FaultKind::HeadTrackingGained;
                break;
            case FaultKind::PositionTrackingLost:
                lose(now.position_lost, fault.time);
                break;
            case FaultKind::PositionTrackingGained:
                now.position_lost.reset();
                break;
            case FaultKind::OrientationTrackingLost:
                lose(now.orientation_lost, fault.time);
                break;
            case FaultKind::OrientationTrackingGained:
                now.orientation_lost.reset();
                break;
            case FaultKind::GazeTrackingLost:
                lose(now.gaze_lost, fault.time);
                break;
            case FaultKind::GazeTrackingGained:
                now.gaze_lost.reset();
                break;
            case FaultKind::FormFactorLost:
            case FaultKind::FormFactorGained:
                now.form_factor_available = fault.kind == FaultKind::FormFactorGained;
                break;
            case FaultKind::MaskRemoved:
            case FaultKind::MaskRestored:
                now.has_visibility_mask = fault.kind == FaultKind::MaskRestored;
                break;
            case FaultKind::SlowCompositor:
                now.compositor_frame = fault.span;
                break;
            default:  // happens once and leaves nothing
                break;
        }
    }
    return now;
}

std::vector<ScriptedFault> Faults::between(Nanoseconds after, Nanoseconds until) const {
    const std::lock_guard lock(mutex_);
    const auto first = std::ranges::upper_bound(faults_, after, {}, &ScriptedFault::time);
    const auto last = std::ranges::upper_bound(faults_, until, {}, &ScriptedFault::time);
    return {first, std::max(first, last)};
}

Nanoseconds Faults::last_recentring(Nanoseconds time) const {
    const std::lock_guard lock(mutex_);
    Nanoseconds last = 0;
    for (const ScriptedFault& fault : faults_) {
        if (fault.time > time) break;
        if (fault.kind == FaultKind::Recentre) last = std::max<Nanoseconds>(fault.time, 0);
    }
    return last;
}

}  // namespace foveray::simulator
