#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/frame.h"
#include "base/headset_profile.h"
#include "base/image.h"
#include "base/settings.h"
#include "render/accel_scene.h"
#include "render/history.h"
#include "render/lighting.h"
#include "render/primary.h"
#include "render/probes.h"
#include "render/ray_counters.h"
#include "render/resolve.h"
#include "render/sampling.h"
#include "render/shadows.h"
#include "shaders/shared/surface.h"

namespace foveray::render {

/// A resolved pixel, unpacked.
struct Pixel {
    vec3 radiance{0.0f};
    float coverage = 0.0f;
    vec3 transmittance{1.0f};
    bool visible = false;
    vec3 added{0.0f};
    float depth = 0.0f;
};

struct Picture {
    uvec2 size{0};
    std::vector<Pixel> pixels;

    const Pixel& at(std::uint32_t x, std::uint32_t y) const { return pixels[std::size_t{y} * size.x + x]; }
    const Pixel& center() const { return at(size.x / 2, size.y / 2); }
};

struct Rendered {
    SampleGrid grid;
    std::vector<shared::Surface> surfaces;  // of the last sub-sample
    std::vector<shared::LightSample> light;
    std::vector<Picture> views;
    std::array<shared::GazeFrame, 2> gaze{};
    RayCounts rays{};
    std::uint64_t triangles = 0;  // of all instances
};

/// One frame to render. World and stage are the same.
struct Shot {
    std::vector<View> views;
    Settings settings;
    Acuity acuity;
    bool every_pixel = true;
    Fovea fovea;
    std::vector<HiddenMesh> hidden;
    Nanoseconds time = 0;
    vk::DeviceAddress room = 0;
    bool history = false;      // true: shots are frames of a sequence; false: each stands alone
    bool read_samples = true;  // false: surfaces and light stay empty
    /// Takes the place of the lit samples; radiance by direction from the eye, for polar grids.
    std::function<shared::LightSample(vec3 direction, float distance)> paint;
};

/// All stages of a picture over one scene.
class LightRig {
  public:
    LightRig(const gpu::Device& device, const scene::Scene& scene);

    Rendered render(const Shot& shot);
    gpu::TextureTable& textures() { return textures_; }
    const ProbeStage& probes() const { return probes_; }

  private:
    std::vector<std::byte> read(const gpu::Buffer& source, vk::DeviceSize size);
    LightLayers paint(const Shot& shot, const Rendered& rendered);
    void resolve(const Shot& shot, const LightLayers& light, bool real, Rendered& rendered);

    const gpu::Device& device_;
    gpu::FrameRing ring_;
    gpu::TextureTable textures_;
    RayPipeline pipeline_;
    scene::SceneAnimator animator_;
    GpuScene gpu_scene_;
    AccelScene accel_;
    ProbeStage probes_;
    SamplingStage sampling_;
    PrimaryStage primary_;
    ShadowStage shadows_;
    LightingStage lighting_;
    HistoryStage history_;
    ResolveStage resolve_;
    RayCounters counters_;
    gpu::Buffer painted_;
};

/// Three channels.
FloatImage radiance_of(const Picture& picture);
/// At the origin or elsewhere, looking along -z unless turned; half-angles in degrees.
View square_view(float half_angle_degrees, std::uint32_t pixels, Pose stage_from_eye = {});
/// A pose at `eye` that looks at `target`.
Pose look_at(vec3 eye, vec3 target);
/// Unit direction of a pixel's centre, in stage space.
vec3 direction_of(const View& view, std::uint32_t x, std::uint32_t y);

}  // namespace foveray::render
