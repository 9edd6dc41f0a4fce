#pragma once

#include "xr/simulator/control/control_socket.h"

namespace foveray::simulator {

class Instance;

/// Carries out a line of the control socket; docs/simulator.md lists the commands. What it changes holds from
/// the next frame on.
ControlSocket::Reply run_command(Instance& instance, const std::string& line);

}  // namespace foveray::simulator
