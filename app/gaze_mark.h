#pragma once

#include "base/image.h"

namespace foveray::app {

/// Draws a thin ring at a place in 0..1 from the top left; a dimmer one where the gaze is held or estimated.
void draw_gaze_mark(Image& picture, vec2 place, bool valid);

}  // namespace foveray::app
