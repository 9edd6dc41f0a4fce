#pragma once

#include <optional>

#include "app/offscreen/offscreen.h"
#include "render/scene/scene_builder.h"

namespace foveray::app {

/// Things on a table, some of which are there, for scenes that change.
struct StillLife {
    scene::SceneBuilder builder;

    /// There is always a shape, out of sight, so that all have the same pipeline.
    explicit StillLife(vec3 environment = vec3(0.3f));

    scene::NodeId add_box(vec3 place, const scene::Material& material,
                          std::vector<scene::Presence> when = {});
    scene::NodeId add_ball(vec3 place, const scene::Material& material,
                           std::vector<scene::Presence> when = {});
    /// A lamp of 0.3 m that shines along `direction`.
    scene::NodeId add_lamp(vec3 place, vec3 direction, vec3 radiance, std::vector<scene::Presence> when = {});
    scene::Scene build() { return std::move(builder).build(); }
};

scene::Material matte(vec3 color);
scene::Material unlit(vec3 color);

/// Draws scenes one after the other with the pipeline of the first, because making one takes long.
class Easel {
  public:
    explicit Easel(const gpu::Device& device) : device_(device) {}

    /// Nothing of the scene before is left, probes and history included.
    Offscreen& put(const scene::Scene& scene);
    struct Drawn {
        Image picture;
        render::RayCounts rays{};
    };
    Drawn draw(const scene::Scene& scene, const Shot& shot);

  private:
    const gpu::Device& device_;
    std::optional<Offscreen> offscreen_;
};

/// Of the scene's middle from the front, every pixel.
Shot front_shot(Nanoseconds time, std::uint32_t pixels = 48);
/// The same in polar images round a gaze that looks beside it.
Shot side_shot(Nanoseconds time, std::uint32_t pixels = 48);

/// Largest difference of a colour, of 255.
int largest_difference(const Image& a, const Image& b);
double mean_difference(const Image& a, const Image& b);

}  // namespace foveray::app
