#include "app/import/importers.h"

#include <array>

#include "app/import/vive_pro_eye.h"

namespace foveray::app {

std::span<const Importer> importers() {
    static constexpr std::array table = {
        Importer{"vive-pro-eye", "Unity UXF trackers' Eye_gaze_*.csv and VR_move_*.csv of one trial",
                 read_vive_pro_eye},
    };
    return table;
}

}  // namespace foveray::app
