#include "app/inputs.h"

#include "app/program.h"
#include "base/headset_profile.h"

namespace foveray::app {

Inputs load_inputs(const PictureOptions& options, const Session* session) {
    Inputs inputs;
    if (options.scene) {
        inputs.scene_file = *options.scene;
    } else if (session && session->scene) {
        inputs.scene_file = *session->scene;
    } else {
        inputs.scene_file = assets_folder() / "scenes/demo.json";
    }
    inputs.scene =
        std::make_shared<const scene::Scene>(scene::load_scene(inputs.scene_file, &inputs.scene_files));
    inputs.shapes = user_shapes::ShapeStore({.gpu = options.gpu, .validation = validation_wanted()});
    inputs.user_shaders = inputs.shapes.prepare(*inputs.scene);

    // The session's calibration is that of the session's camera, not of another one.
    auto calibration = options.calibration;
    if (options.camera) {
        inputs.camera_name = *options.camera;
    } else if (session && session->camera) {
        inputs.camera_name = session->camera->string();
        if (!calibration) calibration = session->calibration;
    }
    if (!inputs.camera_name.empty())
        inputs.camera = passthrough::open_camera(inputs.camera_name, calibration);
    return inputs;
}

}  // namespace foveray::app
