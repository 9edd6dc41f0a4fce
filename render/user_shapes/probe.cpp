#include "render/user_shapes/probe.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <spdlog/fmt/fmt.h>

#include "base/error.h"
#include "render/user_shapes/probe_request.h"

namespace foveray::user_shapes {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void throw_system(const char* what) {
    throw_missing("probe of a shape", std::string(what) + ": " + std::strerror(errno),
                  "free memory or processes");
}

class FileDescriptor {
  public:
    explicit FileDescriptor(int fd) : fd_(fd) {
        if (fd < 0) throw_system("no file descriptor");
    }
    ~FileDescriptor() { close(); }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    int get() const { return fd_; }
    void close() {
        if (fd_ >= 0) ::close(fd_);
        fd_ = -1;
    }

  private:
    int fd_;
};

/// The child process, its standard input filled and its standard output at hand. Killed when this goes.
class Child {
  public:
    Child(const std::filesystem::path& program, const std::string& input)
        : Child(program, input, make_pipe()) {}
    ~Child() {
        if (pid_ > 0) ::kill(pid_, SIGKILL);
        wait();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// The next line it writes; empty: none until then, or it ended.
    std::optional<std::string> line(Clock::time_point until) {
        for (;;) {
            if (const auto end = buffer_.find('\n'); end != std::string::npos) {
                const std::string line = buffer_.substr(0, end);
                buffer_.erase(0, end + 1);
                return line;
            }
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
            pollfd wanted{output_.get(), POLLIN, 0};
            if (left.count() <= 0 || ::poll(&wanted, 1, static_cast<int>(left.count())) <= 0) {
                if (left.count() > 0 && errno == EINTR) continue;
                return std::nullopt;
            }
            char bytes[4096];
            const ssize_t size = ::read(output_.get(), bytes, sizeof bytes);
            if (size <= 0) {
                ended_ = true;
                return std::nullopt;
            }
            buffer_.append(bytes, static_cast<std::size_t>(size));
        }
    }
    bool ended() const { return ended_; }
    /// Its wait status; waits for its end.
    int wait() {
        if (pid_ > 0) {
            while (::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
            }
        }
        pid_ = 0;
        return status_;
    }

  private:
    struct Pipe {
        int read = -1, write = -1;
    };
    static Pipe make_pipe() {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) throw_system("no pipe");
        return {ends[0], ends[1]};
    }

    Child(const std::filesystem::path& program, const std::string& input, Pipe pipe) : output_(pipe.read) {
        FileDescriptor write_end(pipe.write);
        const FileDescriptor in(::memfd_create("shape", MFD_CLOEXEC));
        for (std::size_t done = 0; done < input.size();) {
            const ssize_t size = ::write(in.get(), input.data() + done, input.size() - done);
            if (size <= 0) throw_system("cannot write");
            done += static_cast<std::size_t>(size);
        }
        ::lseek(in.get(), 0, SEEK_SET);

        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, in.get(), STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, write_end.get(), STDOUT_FILENO);
        std::string name = program.string(), command = probe_command;
        char* const argv[] = {name.data(), command.data(), nullptr};
        const int failed = ::posix_spawn(&pid_, name.c_str(), &actions, nullptr, argv, environ);
        posix_spawn_file_actions_destroy(&actions);
        if (failed != 0) {
            pid_ = 0;
            errno = failed;
            throw_system("cannot start a process");
        }
    }

    FileDescriptor output_;
    pid_t pid_ = 0;
    int status_ = 0;
    bool ended_ = false;
    std::string buffer_;
};

std::string seconds(std::chrono::milliseconds time) { return fmt::format("{} s", time.count() / 1000.0); }

}  // namespace

void probe(const scene::Scene& scene, const scene::UserShape& user, scene::UserShapeId id,
           const ProbeOptions& options) {
    Json input = to_json(make_request(scene, user, id));
    input["validation"] = options.validation;
    input["gpu"] = options.gpu ? Json(*options.gpu) : Json();
    Child child(options.program, input.dump());

    const std::string where = user.code.file.string() + ":" + std::to_string(user.code.line);
    const std::string function(user.code.function());
    const auto refuse = [&](const std::string& reason, const std::string& remedy) {
        throw_bad_input(where, function + " " + reason, remedy);
    };
    const auto crashed = [&] {
        const int status = child.wait();
        if (WIFSIGNALED(status)) {
            refuse(fmt::format("crashes the process that tries it (signal {})", WTERMSIG(status)),
                   "simplify it");
        }
        refuse("ends the process that tries it", "simplify it");
    };

    bool runs = false;
    std::optional<std::string> answer;
    do {
        const auto limit = runs ? options.limit : options.start_limit;
        answer = child.line(Clock::now() + limit);
        if (!answer && child.ended()) crashed();
        if (!answer && runs) {
            refuse("does not finish a small picture within " + seconds(limit),
                   "look for a loop without an end, or make it cheaper");
        }
        if (!answer) refuse("is not compiled by the driver within " + seconds(limit), "simplify it");
        runs = *answer == probe_runs;
    } while (runs || *answer == probe_prepares);
    const Json result = Json::parse(*answer, nullptr, false);
    if (!result.is_object()) crashed();
    if (result.contains("fault")) {
        throw Fault(result["fault"].get<ExitCode>(), result["where"], result["what"], "");
    }
    if (result.value("of_color", false)) {
        throw_bad_input(user.code.file.string() + ":" + std::to_string(user.code.color_line),
                        "color_at " + result["refused"].get<std::string>(), "correct the function");
    }
    if (result.contains("refused")) refuse(result["refused"], "correct the function or the bounds");
}

}  // namespace foveray::user_shapes
