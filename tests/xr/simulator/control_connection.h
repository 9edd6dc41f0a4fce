#pragma once

#include <filesystem>
#include <string>

namespace foveray::simulator_tests {

/// A program that sends commands to the simulator's control socket.
class ControlConnection {
  public:
    /// Waits some seconds for the socket to come.
    explicit ControlConnection(const std::filesystem::path& socket);
    ~ControlConnection();
    ControlConnection(const ControlConnection&) = delete;
    ControlConnection& operator=(const ControlConnection&) = delete;

    void send(const std::string& text);
    /// The next reply; empty when the other side closed.
    std::string reply();
    std::string ask(const std::string& command) {
        send(command + "\n");
        return reply();
    }
    void close();

  private:
    int fd_ = -1;
};

}  // namespace foveray::simulator_tests
