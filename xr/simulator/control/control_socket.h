#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <thread>

namespace foveray::simulator {

/// A Unix stream socket that answers each line with one line, on a thread of its own. Lines of a connection
/// are answered one after another.
class ControlSocket {
  public:
    /// Gives the reply, without a line's end, or nothing while it has to wait.
    using Reply = std::function<std::optional<std::string>()>;
    using Answer = std::function<Reply(const std::string& line)>;

    /// Sockets that programs left in the same folder when they were killed are removed. Throws
    /// Fault(BadInput) when the socket cannot be made, or another program listens there.
    ControlSocket(const std::filesystem::path& path, Answer answer);
    /// Ends the thread and removes the socket.
    ~ControlSocket();
    ControlSocket(const ControlSocket&) = delete;
    ControlSocket& operator=(const ControlSocket&) = delete;

    /// Replies that wait are asked again.
    void wake();

  private:
    struct Connection {
        int fd;
        std::string input, output;
        Reply waiting;
        bool input_ended = false, broken = false;
    };
    void run();
    void receive(Connection& connection);
    void answer_lines(Connection& connection);
    void send_output(Connection& connection);
    void accept_one();

    std::filesystem::path path_;
    Answer answer_;
    int listener_ = -1, wake_ = -1;
    std::list<Connection> connections_;  // of the thread
    std::atomic<bool> stopping_ = false;
    std::thread thread_;
};

}  // namespace foveray::simulator
