#include "tests/passthrough/compositor_harness.h"

#include <cmath>

namespace foveray::passthrough {
namespace {

glm::uvec2 halves(vec4 v) { return {glm::packHalf2x16({v.x, v.y}), glm::packHalf2x16({v.z, v.w})}; }

}  // namespace

Composite CompositorTest::compose(const CompositorSetup& setup) {
    const uvec2 size = setup.view.size;
    const std::size_t count = std::size_t{size.x} * size.y;

    gpu::Buffer resolved(device(), "resolved", count * sizeof(shared::ResolvedPixel), gpu::Residence::Upload);
    gpu::Buffer real(device(), "real", count * sizeof(shared::ResolvedRealPixel), gpu::Residence::Upload);
    std::vector<shared::ResolvedPixel> pixels;
    std::vector<shared::ResolvedRealPixel> reals;
    std::vector<float> distances;
    for (std::uint32_t y = 0; y < size.y; ++y) {
        for (std::uint32_t x = 0; x < size.x; ++x) {
            const VirtualPixel p = setup.virtual_part(x, y);
            pixels.push_back({halves(p.visible ? p.radiance : vec4(vec3(p.radiance), -1.0f))});
            reals.push_back({halves({p.transmittance, 0.0f}), halves({p.added, 0.0f})});
            distances.push_back(p.depth);
        }
    }
    resolved.write(gpu::range_bytes(pixels));
    real.write(gpu::range_bytes(reals));
    gpu::Buffer color(device(), "color", count * 4, gpu::Residence::Readback);
    gpu::Buffer depth(device(), "depth", count * 4, gpu::Residence::Readback);
    depth.write(gpu::range_bytes(distances));

    gpu::TextureTable textures(device());
    gpu::Buffer scene(device(), "scene", sizeof(shared::SceneData), gpu::Residence::Upload);
    shared::SceneData scene_data{};
    scene_data.environment.texture = shared::NO_TEXTURE;
    scene_data.environment.intensity = 1.0f;
    scene_data.environment.constant = setup.environment.value_or(vec3(0));
    gpu::Image environment_image;
    if (const FloatImage& picture = setup.environment_picture; !picture.empty()) {
        gpu::ImageInfo info;
        info.extent = vk::Extent2D(picture.width, picture.height);
        info.format = vk::Format::eR32G32B32A32Sfloat;
        info.usage = vk::ImageUsageFlagBits::eSampled;
        gpu::Uploader uploader(device());
        environment_image = uploader.image("environment", info, gpu::range_bytes(picture.pixels));
        scene_data.environment.environment_from_world = mat3(1.0f);
        scene_data.environment.texture = textures.add(environment_image.view(), {});
    }
    scene.write(gpu::bytes_of(scene_data));

    RoomStage room_stage(device(), textures, 1, setup.calibration, setup.surfaces, setup.far_distance);
    const Compositor compositor(device(), textures);
    shared::ViewImage image{resolved.address(), real.address(), color.address(), depth.address(), size};
    gpu::submit_and_wait(device(), [&](const gpu::Commands& cmd) {
        const Room room = room_stage.record(cmd, 0, setup.moment, setup.settings);
        compositor.record(cmd, setup.view, image, room,
                          setup.environment ? scene.address() : 0, setup.background, setup.settings);
        cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::HostRead);
    });

    color.invalidate();
    depth.invalidate();
    const auto colors = color.mapped_as<glm::u8vec4>();
    const auto depths = depth.mapped_as<float>();
    return {size, {colors.begin(), colors.begin() + count}, {depths.begin(), depths.begin() + count}};
}

View wide_view(uvec2 size) {
    View view;
    view.size = size;
    const float up = std::atan(static_cast<float>(size.y) / static_cast<float>(size.x));
    view.fov = {-pi / 4, pi / 4, up, -up};
    return view;
}

CameraFramePtr camera_frame(const foveray::Image& picture, std::uint64_t sequence) {
    auto frame = std::make_shared<CameraFrame>();
    frame->sequence = sequence;
    frame->picture = picture;
    return frame;
}

foveray::Image plain_picture(uvec2 size, glm::u8vec3 color) {
    foveray::Image image(size.x, size.y, 4);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = i % 4 == 3 ? 255 : color[static_cast<int>(i % 4)];
    }
    return image;
}

}  // namespace foveray::passthrough
