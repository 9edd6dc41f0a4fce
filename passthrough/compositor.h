#pragma once

#include "base/frame.h"
#include "base/settings.h"
#include "base/view.h"
#include "passthrough/room.h"
#include "render/gpu/compute_pipeline.h"
#include "shaders/shared/view_image.h"

namespace foveray::passthrough {

/// What stands behind the virtual part.
enum class Background : std::uint32_t {
    Camera,       // the camera picture, the environment where it does not reach; opaque
    Environment,  // the environment, or black; opaque
    Runtime,      // the headset's own: premultiplied colour, shadows reduced to alpha
};

/// `has_camera`: foveray has a camera of its own, whether or not a picture has come yet.
Background choose_background(bool has_camera, BlendMode blend, const Settings& settings);

/// Tone-maps the virtual part of a view, puts it over what stands behind, and projects the depth.
class Compositor {
  public:
    Compositor(const gpu::Device& device, const gpu::TextureTable& textures);

    /// `image` is the view's: its ResolvedPixels, written by compute shaders before, become color (sRGB,
    /// premultiplied alpha) and depth (settings.near_m to far_m). Whoever reads those puts a barrier after
    /// Access::ComputeWrite. `scene_data`: address of shared::SceneData for its environment; 0: black.
    void record(const gpu::Commands& cmd, const View& view, const shared::ViewImage& image, const Room& room,
                vk::DeviceAddress scene_data, Background background, const Settings& settings) const;

  private:
    gpu::ComputePipeline pipeline_;
};

}  // namespace foveray::passthrough
