// foveray-openxr-simulator --control: sends commands to a simulated headset and prints its replies.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

#include "xr/simulator/control_path.h"

namespace {

constexpr int exit_refused = 1, exit_unreachable = 2;

bool send_line(int socket, const std::string& line) {
    const std::string text = line + '\n';
    for (std::size_t sent = 0; sent < text.size();) {
        const ssize_t size = send(socket, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
        if (size <= 0) return false;
        sent += static_cast<std::size_t>(size);
    }
    return true;
}

bool receive_line(int socket, std::string& line) {
    line.clear();
    for (char c; recv(socket, &c, 1, 0) == 1;) {
        if (c == '\n') return true;
        line += c;
    }
    return false;
}

/// Prints the reply. The exit code.
int ask(int socket, const std::string& line) {
    std::string reply;
    if (!send_line(socket, line) || !receive_line(socket, reply)) {
        std::fputs("foveray-openxr-simulator: the headset is gone\n", stderr);
        return exit_unreachable;
    }
    std::puts(reply.c_str());
    std::fflush(stdout);
    return reply.starts_with("ok") ? EXIT_SUCCESS : exit_refused;
}

}  // namespace

/// PID or a socket's path, then a command; without one, commands are the lines of standard input.
int main(int count, char** arguments) {
    if (count < 2) {
        std::fputs("usage: foveray-openxr-simulator --control PID|SOCKET [COMMAND…]\n", stderr);
        return exit_unreachable;
    }
    const std::string target = arguments[1];
    const bool is_process = target.find_first_not_of("0123456789") == std::string::npos && !target.empty();
    const auto path =
        is_process ? foveray::simulator::control_folder() / target : std::filesystem::path(target);
    const int socket = foveray::simulator::connect_to_control(path);
    if (socket < 0) {
        std::fprintf(stderr,
                     "foveray-openxr-simulator: %s: no headset listens there (start its program with "
                     "FOVERAY_SIMULATOR_CONTROL=1)\n",
                     path.c_str());
        return exit_unreachable;
    }
    std::string line;
    for (int i = 2; i < count; ++i) line += (i > 2 ? " " : "") + std::string(arguments[i]);
    int code = EXIT_SUCCESS;
    if (count > 2) {
        code = ask(socket, line);
    } else {
        while (code != exit_unreachable && std::getline(std::cin, line)) {
            if (!line.empty()) code = std::max(code, ask(socket, line));
        }
    }
    close(socket);
    return code;
}
