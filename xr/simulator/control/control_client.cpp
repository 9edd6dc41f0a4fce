// foveray-openxr-simulator --control: sends commands to a simulated headset and prints its replies.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

#include "xr/simulator/control/control_path.h"

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

/// A program that was just started listens once it has made its instance.
int connect_to_process(pid_t process) {
    const auto path = foveray::simulator::control_socket_path(process);
    for (int i = 0; i < 500; ++i) {
        const int socket = foveray::simulator::connect_to_control(path);
        const bool lives = kill(process, 0) == 0 || errno == EPERM;
        if (socket >= 0 || !lives) return socket;
        usleep(20'000);
    }
    return -1;
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
    pid_t process = 0;
    const auto [end, error] = std::from_chars(target.data(), target.data() + target.size(), process);
    const bool is_process = error == std::errc{} && *end == '\0' && process > 0;
    const int socket =
        is_process ? connect_to_process(process) : foveray::simulator::connect_to_control(target);
    if (socket < 0) {
        std::fprintf(
            stderr,
            "foveray-openxr-simulator: %s: no headset listens there; start its program with --listen\n",
            target.c_str());
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
