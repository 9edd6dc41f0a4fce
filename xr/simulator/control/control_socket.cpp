#include "xr/simulator/control/control_socket.h"

#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <mutex>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "base/error.h"
#include "xr/simulator/control/control_path.h"

namespace foveray::simulator {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_line = 4096, most_output = 65536, most_connections = 32;

[[noreturn]] void throw_no_socket(const fs::path& path, const std::string& why) {
    throw_bad_input(path.string(), "cannot be the control socket: " + why,
                    "name another path with FOVERAY_SIMULATOR_CONTROL");
}

/// The folder of this user's sockets, which nobody else may enter.
void make_own_folder(const fs::path& folder) {
    if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) throw_no_socket(folder, std::strerror(errno));
    struct stat status {};
    if (lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != getuid() ||
        (status.st_mode & 077) != 0)
        throw_no_socket(folder, "the folder is open to others");
}

bool lies_a_socket_at(const fs::path& path) {
    std::error_code ignored;
    return fs::is_socket(fs::symlink_status(path, ignored));
}

void remove_dead_sockets(const fs::path& folder) {
    std::error_code ignored;
    const auto is_dead = [](const std::string& process) {
        pid_t id = 0;
        const auto [end, error] = std::from_chars(process.data(), process.data() + process.size(), id);
        return error == std::errc{} && *end == '\0' && id > 0 && kill(id, 0) != 0 && errno == ESRCH;
    };
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (is_dead(entry.path().filename().string()) && lies_a_socket_at(entry.path()) &&
            !is_listening(entry.path()))
            unlink(entry.path().c_str());
    }
}

int listen_at(const fs::path& path) {
    static std::mutex mutex;  // between two headsets of one program
    const std::lock_guard lock(mutex);
    sockaddr_un address;
    if (!make_address(path, address)) throw_no_socket(path, "the path is too long");
    if (lies_a_socket_at(path)) {
        if (is_listening(path)) throw_no_socket(path, "another headset listens there");
        unlink(path.c_str());
    }
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0) throw_no_socket(path, std::strerror(errno));
    if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 || listen(fd, 16) != 0) {
        const std::string why = std::strerror(errno);
        close(fd);
        throw_no_socket(path, why);
    }
    return fd;
}

}  // namespace

ControlSocket::ControlSocket(const fs::path& path, Answer answer) : path_(path), answer_(std::move(answer)) {
    if (path.parent_path() == control_folder()) {
        make_own_folder(path.parent_path());
        remove_dead_sockets(path.parent_path());
    }
    wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (wake_ < 0) throw_no_socket(path, std::strerror(errno));
    try {
        listener_ = listen_at(path);
    } catch (...) {
        close(wake_);
        throw;
    }
    // Signals are the program's own.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { run(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ControlSocket::~ControlSocket() {
    stopping_ = true;
    wake();
    thread_.join();
    for (const Connection& connection : connections_) close(connection.fd);
    close(wake_);
    unlink(path_.c_str());
    close(listener_);
}

void ControlSocket::wake() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = write(wake_, &one, sizeof one);
}

void ControlSocket::accept_one() {
    const int fd = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd >= 0) {
        connections_.push_back({fd, {}, {}, nullptr});
    } else if (errno == EMFILE || errno == ENFILE) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));  // until the program closes some
    }
}

void ControlSocket::receive(Connection& connection) {
    char buffer[4096];
    const ssize_t size = recv(connection.fd, buffer, sizeof buffer, 0);
    if (size > 0) {
        connection.input.append(buffer, static_cast<std::size_t>(size));
    } else if (size == 0) {
        connection.input_ended = true;
    } else if (errno != EAGAIN && errno != EINTR) {
        connection.broken = true;
    }
}

void ControlSocket::answer_lines(Connection& connection) {
    while (connection.output.size() < most_output) {
        if (connection.waiting) {
            const auto reply = connection.waiting();
            if (!reply) return;
            connection.output += *reply + '\n';
            connection.waiting = nullptr;
        }
        const std::size_t end = connection.input.find('\n');
        if (end == std::string::npos) break;
        std::string line = connection.input.substr(0, end);
        connection.input.erase(0, end + 1);
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (!line.empty()) connection.waiting = answer_(line);
    }
    if (connection.input.size() <= longest_line || connection.input.find('\n') != std::string::npos) return;
    connection.output += "error the line is too long\n";
    connection.input.clear();
    connection.input_ended = true;
}

void ControlSocket::send_output(Connection& connection) {
    if (connection.output.empty()) return;
    const ssize_t size =
        send(connection.fd, connection.output.data(), connection.output.size(), MSG_NOSIGNAL);
    if (size > 0) {
        connection.output.erase(0, static_cast<std::size_t>(size));
    } else if (errno != EAGAIN && errno != EINTR) {
        connection.broken = true;
    }
}

void ControlSocket::run() {
    while (!stopping_) {
        const bool has_room = connections_.size() < most_connections;
        std::vector<pollfd> polled{{wake_, POLLIN, 0}, {has_room ? listener_ : -1, POLLIN, 0}};
        for (const Connection& connection : connections_) {
            const bool reads = !connection.input_ended && connection.input.size() <= longest_line &&
                               connection.output.size() < most_output;
            const bool has_line = !connection.waiting && connection.input.find('\n') != std::string::npos;
            const bool writes = !connection.output.empty() || has_line;
            polled.push_back(
                {connection.fd, static_cast<short>((reads ? POLLIN : 0) | (writes ? POLLOUT : 0)), 0});
        }
        if (poll(polled.data(), polled.size(), -1) < 0) continue;
        std::uint64_t count = 0;
        if (polled[0].revents) [[maybe_unused]]
            const auto size = read(wake_, &count, sizeof count);
        std::size_t i = 2;
        for (Connection& connection : connections_) {
            const short events = polled[i++].revents;
            if (events & POLLIN) receive(connection);
            // Gone both ways: nobody reads a reply.
            if ((events & (POLLHUP | POLLERR)) && !(events & POLLIN)) connection.broken = true;
            answer_lines(connection);
            send_output(connection);
        }
        std::erase_if(connections_, [](const Connection& connection) {
            const bool done = connection.input_ended && !connection.waiting && connection.output.empty();
            if (done || connection.broken) close(connection.fd);
            return done || connection.broken;
        });
        if (polled[1].revents) accept_one();
    }
}

}  // namespace foveray::simulator
