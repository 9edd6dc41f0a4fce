#include "tests/xr/simulator/control_connection.h"

#include <chrono>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

namespace foveray::simulator_tests {

ControlConnection::ControlConnection(const std::filesystem::path& socket)
    : fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, socket.c_str(), sizeof address.sun_path - 1);
    const timeval patience{20, 0};
    setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    for (int i = 0; i < 2000; ++i) {
        if (connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << socket << ": " << std::strerror(errno);
}

ControlConnection::~ControlConnection() { close(); }

void ControlConnection::close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
}

void ControlConnection::send(const std::string& text) {
    EXPECT_EQ(::send(fd_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
}

std::string ControlConnection::reply() {
    std::string line;
    for (char c; recv(fd_, &c, 1, 0) == 1;) {
        if (c == '\n') return line;
        line += c;
    }
    return line;
}

}  // namespace foveray::simulator_tests
