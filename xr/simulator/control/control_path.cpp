#include "xr/simulator/control/control_path.h"

#include <cstdlib>
#include <cstring>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace foveray::simulator {

std::filesystem::path control_folder() {
    const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
    if (runtime && *runtime) return std::filesystem::path(runtime) / "foveray-simulator";
    return "/tmp/foveray-simulator-" + std::to_string(getuid());
}

std::filesystem::path control_socket_path(pid_t process) {
    return control_folder() / std::to_string(process);
}

bool make_address(const std::filesystem::path& path, sockaddr_un& address) {
    address = {};
    address.sun_family = AF_UNIX;
    const std::string& text = path.native();
    if (text.empty() || text.size() >= sizeof address.sun_path) return false;
    std::memcpy(address.sun_path, text.c_str(), text.size());
    return true;
}

int connect_to_control(const std::filesystem::path& path) {
    sockaddr_un address;
    if (!make_address(path, address)) return -1;
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (fd < 0) return -1;
    if (connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return fd;
    close(fd);
    return -1;
}

bool is_listening(const std::filesystem::path& path) {
    const int fd = connect_to_control(path);
    if (fd >= 0) close(fd);
    return fd >= 0;
}

}  // namespace foveray::simulator
