#pragma once

#include <filesystem>
#include <sys/types.h>
#include <sys/un.h>

/// Where the control sockets of simulated headsets lie. Used by the library and by the program that sends.
namespace foveray::simulator {

/// $XDG_RUNTIME_DIR/foveray-simulator, or without that variable /tmp/foveray-simulator-UID.
std::filesystem::path control_folder();
/// The socket of the program with that process id.
std::filesystem::path control_socket_path(pid_t process);
/// False when the path is too long for a socket.
bool make_address(const std::filesystem::path& path, sockaddr_un& address);
/// Connected, or -1.
int connect_to_control(const std::filesystem::path& path);
bool is_listening(const std::filesystem::path& path);

}  // namespace foveray::simulator
