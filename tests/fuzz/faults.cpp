#include "tests/fuzz/faults.h"

#include <chrono>
#include <cstring>
#include <fstream>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

namespace foveray::fuzz {
namespace {

/// The name and the value of a line.
std::string random_fault(Random& random, const char* separator) {
    const char* const plain[] = {"user_absent",
                                 "user_present",
                                 "position_tracking_lost",
                                 "position_tracking_gained",
                                 "orientation_tracking_lost",
                                 "orientation_tracking_gained",
                                 "gaze_tracking_lost",
                                 "gaze_tracking_gained",
                                 "form_factor_lost",
                                 "form_factor_gained"};
    const char* const with_value[][2] = {{"slow_compositor", "50"},
                                         {"slow_compositor", "0"},
                                         {"swapchain_timeout", "3"},
                                         {"out_of_memory", "xrCreateSwapchain"},
                                         {"fail", "xrEndFrame=XR_ERROR_LAYER_INVALID x2"},
                                         {"fail", "xrBeginFrame=XR_ERROR_RUNTIME_FAILURE"},
                                         {"fail", "xrCreateInstance=XR_ERROR_RUNTIME_UNAVAILABLE"},
                                         {"fail", "xrLocateSpace=XR_ERROR_VALIDATION_FAILURE x5"}};
    const char* const losses[][2] = {{"session_loss", ""},
                                     {"loss_pending", "0.2"},
                                     {"instance_loss", ""},
                                     {"instance_loss_pending", "0.3"}};
    if (random.chance(10)) {
        const auto& [name, value] = losses[random.below(std::size(losses))];
        return std::string(name) + separator + value;
    }
    if (random.chance(40)) {
        const auto& [name, value] = with_value[random.below(std::size(with_value))];
        return std::string(name) + separator + value;
    }
    return std::string(plain[random.below(std::size(plain))]) + separator;
}

std::string random_command(Random& random) {
    switch (random.below(6)) {
        case 0:
            return "fault " + random_fault(random, " ") + "\n";
        case 1:
            return "head " + std::to_string(random.number()) + " 1 0 0 0 0 1\n";
        case 2:
            return random.pick({"gaze 0 1 -1\n", "gaze invalid\n", "gaze script\n", "head script\n"});
        case 3:
            return random.pick({"press left/trigger\n", "set right/stick_x -1\n", "controller left invalid\n",
                                "controller left 0 1 0 0 0 0 1\n", "controller left script\n"});
        case 4:
            return random.pick({"state\n", "step 3\n", "exit\n", "\n"});
        default: {
            std::string garbage(random.below(200), ' ');
            for (char& c : garbage) c = static_cast<char>(random.bits());
            return garbage;
        }
    }
}

/// -1 while nobody listens.
int connect_to(const std::filesystem::path& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return fd;
    close(fd);
    return -1;
}

}  // namespace

void write_faults(const std::filesystem::path& file, Random& random) {
    std::ofstream out(file);
    out << "at,fault,value\n";
    for (int i = 0; i < 60; ++i) out << 10 + random.below(390) << ',' << random_fault(random, ",") << '\n';
}

void send_commands(const std::atomic<bool>& done, const std::filesystem::path& socket, Random random) {
    while (!done) {
        const int fd = connect_to(socket);
        for (std::size_t left = fd >= 0 ? random.below(20) : 0; left > 0; --left) {
            const std::string text = random_command(random);
            if (send(fd, text.data(), text.size(), MSG_NOSIGNAL) < 0) break;
            char replies[4096];
            if (random.chance(50)) recv(fd, replies, sizeof replies, 0);
        }
        if (fd >= 0) close(fd);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

}  // namespace foveray::fuzz
