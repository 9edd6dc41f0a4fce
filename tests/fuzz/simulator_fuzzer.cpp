// Calls random functions of the simulated runtime in random order with random arguments, from several threads
// at once. What counts is that nothing crashes, hangs or upsets a sanitizer.
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <unistd.h>

#include "base/session.h"
#include "tests/fakes/temporary_folder.h"
#include "tests/fuzz/caller.h"
#include "tests/fuzz/faults.h"
#include "tests/fuzz/vulkan_binding.h"

namespace foveray::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

thread_local const char* running_call = "";

/// Says which call crashed; the seed stands above.
void on_crash(int signal) {
    const auto say = [](std::string_view text) {
        return ::write(STDERR_FILENO, text.data(), text.size()) > 0;
    };
    if (say("crashed in ") && say(running_call)) say("\n");
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

struct Arguments {
    double seconds = 60.0;
    std::uint64_t seed = std::random_device{}();
    int threads = 3;
    bool vulkan = true;  // sessions with graphics too
};

Arguments read_arguments(int count, char** values) {
    Arguments arguments;
    for (int i = 1; i + 1 < count; i += 2) {
        const std::string_view name = values[i];
        if (name == "--seconds") {
            arguments.seconds = std::atof(values[i + 1]);
        } else if (name == "--seed") {
            arguments.seed = std::strtoull(values[i + 1], nullptr, 10);
        } else if (name == "--threads") {
            arguments.threads = std::atoi(values[i + 1]);
        } else if (name == "--vulkan") {
            arguments.vulkan = std::atoi(values[i + 1]) != 0;
        } else {
            std::fprintf(stderr, "there are --seconds N, --seed N, --threads N and --vulkan 0|1, and no %s\n",
                         values[i]);
            std::exit(2);
        }
    }
    return arguments;
}

/// A wearer to whom much happens in a short time.
Session eventful_session() {
    Session session;
    session.headset = "ci";
    session.rate_hz = 30.0;
    session.frames = 400;
    const char* const events[] = {"focus_lost",
                                  "focus_gained",
                                  "visibility_lost",
                                  "visibility_gained",
                                  "head_tracking_lost",
                                  "head_tracking_gained",
                                  "recenter",
                                  "visibility_mask_removed",
                                  "visibility_mask_restored",
                                  "session_pause"};
    for (int i = 0; i < 300; ++i)
        session.events.push_back({i * nanoseconds_per_second / 30, events[i % std::size(events)], ""});
    for (int i = 0; i < 100; ++i) {
        const Nanoseconds time = i * nanoseconds_per_second / 10;
        ControllerState controller;
        controller.valid = i % 4 != 0;
        controller.trigger = static_cast<float>(i % 3) / 2.0f;
        for (const int hand : {0, 1}) session.controllers.push_back({time, hand, controller});
        session.gaze.push_back({time, i % 5 != 0, vec3(0.0f), vec3(0.0f, 0.0f, -1.0f)});
        session.head.push_back({time, {quat(1, 0, 0, 0), vec3(0.0f, 1.6f, 0.01f * static_cast<float>(i))}});
    }
    return session;
}

std::vector<Call> weighted_calls() {
    std::vector<Call> calls;
    for (const auto& group : {instance_calls(), session_calls(), action_calls(), extension_calls()}) {
        for (const Call& call : group) calls.insert(calls.end(), static_cast<std::size_t>(call.weight), call);
    }
    return calls;
}

std::uint64_t call_until(Clock::time_point end, Caller& caller) {
    const std::vector<Call> calls = weighted_calls();
    std::uint64_t count = 0;
    while (Clock::now() < end) {
        for (int i = 0; i < 100; ++i, ++count) {
            const Call& call = caller.random.pick(calls);
            running_call = call.name;
            call.run(caller);
            caller.forget();
        }
    }
    return count;
}

/// xrWaitFrame may block until another thread begins the frame before: this one does, so that all go on.
void free_waiting_threads(const std::atomic<bool>& done, const Functions& functions,
                          const HandlePool& handles) {
    while (!done) {
        for (const XrSession session : handles.all<XrSession>()) functions.xrBeginFrame(session, nullptr);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

int run(const Arguments& arguments) {
    std::printf("seed %llu, %d threads, %g s\n", static_cast<unsigned long long>(arguments.seed),
                arguments.threads, arguments.seconds);
    std::fflush(stdout);
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, on_crash);
    const fakes::TemporaryFolder folder;
    write_session(folder.path() / "session", eventful_session());
    setenv("FOVERAY_SIMULATOR_SESSION", (folder.path() / "session").c_str(), 1);
    setenv("FOVERAY_SIMULATOR_TIME", "virtual", 1);
    Random faults(arguments.seed);
    write_faults(folder.path() / "session" / "faults.csv", faults);
    // Commands come when they come: only without them a seed repeats a single thread's calls.
    const bool commands = arguments.threads > 1;
    if (commands) {
        setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
        setenv("FOVERAY_SIMULATOR_CONTROL", "1", 1);
    }

    const simulator_tests::DirectRuntime runtime;
    const Functions functions(runtime);
    const auto vulkan = arguments.vulkan ? make_vulkan_binding(runtime, functions) : std::nullopt;
    if (!vulkan) std::printf("without Vulkan\n");
    HandlePool handles;
    std::atomic<bool> done = false;
    std::atomic<std::uint64_t> total = 0;
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(arguments.seconds));
    std::thread rescuer([&] { free_waiting_threads(done, functions, handles); });
    std::thread commander([&] {
        const auto socket = folder.path() / "foveray-simulator" / std::to_string(getpid());
        if (commands) send_commands(done, socket, Random(arguments.seed + 1000));
    });
    std::vector<std::thread> threads;
    for (int i = 0; i < arguments.threads; ++i) {
        threads.emplace_back([&, i] {
            Caller caller(arguments.seed + static_cast<std::uint64_t>(i), functions, handles,
                          vulkan ? &*vulkan : nullptr);
            total += call_until(end, caller);
        });
    }
    for (std::thread& thread : threads) thread.join();
    done = true;
    rescuer.join();
    commander.join();
    for (const XrInstance instance : handles.all<XrInstance>()) functions.xrDestroyInstance(instance);
    const auto say = [](const char* what, std::uint64_t count) {
        std::printf("%llu %s\n", static_cast<unsigned long long>(count), what);
    };
    say("instances", handles.made<XrInstance>());
    say("sessions", handles.made<XrSession>());
    say("spaces", handles.made<XrSpace>());
    say("swapchains", handles.made<XrSwapchain>());
    say("actions", handles.made<XrAction>());
    say("hand trackers", handles.made<XrHandTrackerEXT>());
    say("rounds of calls without a crash", total);
    return 0;
}

}  // namespace
}  // namespace foveray::fuzz

int main(int count, char** values) {
    return foveray::fuzz::run(foveray::fuzz::read_arguments(count, values));
}
