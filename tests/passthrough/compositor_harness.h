#pragma once

#include <functional>
#include <limits>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "passthrough/compositor.h"
#include "passthrough/room.h"
#include "shaders/shared/scene.h"
#include "tests/fakes/gpu_fixture.h"

namespace foveray::passthrough {

/// What resolve would have written for one pixel.
struct VirtualPixel {
    vec4 radiance{0.0f};  // premultiplied, and coverage
    vec3 transmittance{1.0f};
    vec3 added{0.0f};
    float depth = std::numeric_limits<float>::infinity();
    bool visible = true;
};

struct Composite {
    uvec2 size{0};
    std::vector<glm::u8vec4> color;
    std::vector<float> depth;
    glm::u8vec4 at(std::uint32_t x, std::uint32_t y) const { return color[std::size_t{y} * size.x + x]; }
};

/// One frame of passthrough and compositor on the GPU, with everything at its simplest unless a test says
/// otherwise.
struct CompositorSetup {
    View view;
    std::function<VirtualPixel(std::uint32_t x, std::uint32_t y)> virtual_part = [](auto, auto) {
        return VirtualPixel{};
    };
    Background background = Background::Camera;
    Settings settings;
    std::optional<Calibration> calibration;
    std::vector<shared::RoomProxy> surfaces;
    float far_distance = 100.0f;
    RoomMoment moment;
    std::optional<vec3> environment;  // constant radiance
    FloatImage environment_picture;   // four channels; takes the constant's place unless empty
};

class CompositorTest : public fakes::GpuTest {
  protected:
    static Composite compose(const CompositorSetup& setup);
};

/// A square-pixel view or camera of 90 degrees from left to right.
View wide_view(uvec2 size);
CameraFramePtr camera_frame(const foveray::Image& picture, std::uint64_t sequence = 0);
foveray::Image plain_picture(uvec2 size, glm::u8vec3 color);

}  // namespace foveray::passthrough
