#pragma once

namespace foveray::app {

/// From here on Ctrl-C (SIGINT) and SIGTERM only set a flag, so that work in hand can end in order; a second
/// one of either kind ends the program at once.
void catch_interrupts();
bool interrupted();

}  // namespace foveray::app
