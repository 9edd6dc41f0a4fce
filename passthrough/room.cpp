#include "passthrough/room.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/log.h"

namespace foveray::passthrough {
namespace {

float area(const shared::RoomProxy& p) {
    const float x = glm::length(p.half_x), y = glm::length(p.half_y), z = glm::length(p.half_z);
    return x * y + y * z + z * x;
}

std::vector<shared::RoomProxy> largest(std::span<const shared::RoomProxy> surfaces) {
    std::vector<shared::RoomProxy> proxies(surfaces.begin(), surfaces.end());
    if (proxies.size() <= shared::MAX_PROXIES) return proxies;
    log::warn("the camera picture is placed by the {} largest of {} real surfaces", shared::MAX_PROXIES,
              proxies.size());
    std::stable_sort(proxies.begin(), proxies.end(),
                     [](const auto& a, const auto& b) { return area(a) > area(b); });
    proxies.erase(proxies.begin() + shared::MAX_PROXIES, proxies.end());
    return proxies;
}

}  // namespace

void fill_camera(shared::RoomParams& params, const Calibration& c, const Pose& stage_from_head) {
    params.camera_from_stage = to_matrix(inverse(stage_from_head * c.head_from_camera));
    params.focal = vec2(c.focal);
    params.principal = vec2(c.centre + 0.5);  // OpenCV counts from the centre of the first pixel
    params.picture_size = vec2(c.size);
    params.model = c.model == LensModel::Fisheye ? shared::CAMERA_FISHEYE : shared::CAMERA_PINHOLE;
    std::copy(c.distortion.begin(), c.distortion.end(), params.distortion);
    const double limit = radius_limit(c);
    params.max_angle = static_cast<float>(c.model == LensModel::Fisheye ? limit : std::atan(limit));
}

RoomStage::RoomStage(const gpu::Device& device, gpu::TextureTable& textures, std::uint32_t frames_in_flight,
                     const std::optional<Calibration>& calibration,
                     std::span<const shared::RoomProxy> surfaces, float far_distance)
    : textures_(textures), calibration_(calibration) {
    set_surfaces(surfaces);
    params_.far_distance = far_distance;
    params_.picture = shared::NO_PICTURE;
    for (std::uint32_t i = 0; i < frames_in_flight; ++i) {
        const std::string number = std::to_string(i);
        Slot slot;
        slot.params =
            gpu::Buffer(device, "room " + number, sizeof(shared::RoomParams), gpu::Residence::Upload);
        if (calibration) {
            const vk::DeviceSize bytes = vk::DeviceSize{4} * calibration->size.x * calibration->size.y;
            slot.staging =
                gpu::Buffer(device, "camera picture staging " + number, bytes, gpu::Residence::Upload);
        }
        slots_.push_back(std::move(slot));
    }
    if (!calibration) return;
    gpu::ImageInfo info;
    info.extent = vk::Extent2D(calibration->size.x, calibration->size.y);
    info.format = vk::Format::eR8G8B8A8Srgb;
    info.usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst;
    image_ = gpu::Image(device, "camera picture", info);
    gpu::SamplerInfo sampler;
    sampler.use_mips = false;
    sampler.u = sampler.v = vk::SamplerAddressMode::eClampToEdge;
    texture_ = textures.add(image_.view(), sampler);
}

void RoomStage::set_surfaces(std::span<const shared::RoomProxy> surfaces) {
    const auto proxies = largest(surfaces);
    std::copy(proxies.begin(), proxies.end(), params_.proxies);
    params_.proxy_count = static_cast<std::uint32_t>(proxies.size());
}

RoomStage::~RoomStage() {
    if (texture_ != shared::NO_PICTURE) textures_.remove(texture_);
}

Room RoomStage::record(const gpu::Commands& cmd, std::uint32_t slot_index, const RoomMoment& moment,
                       const Settings& settings) {
    const auto stage = cmd.stage("passthrough");
    Slot& slot = slots_[slot_index];
    if (moment.picture && moment.picture != uploaded_) {
        upload(cmd, slot.staging, moment.picture->picture);
        uploaded_ = moment.picture;
    }
    shared::RoomParams params = params_;
    params.stage_from_world = to_matrix(inverse(moment.world_from_stage));
    // The compositor exposes the room together with the virtual part, so that a mirror shows it as bright as
    // it is.
    params.exposure = std::exp2(settings.camera_exposure_ev - settings.exposure_ev);
    if (moment.picture) {
        fill_camera(params, *calibration_, moment.stage_from_head);
        params.picture = texture_;
    }
    slot.params.write(gpu::bytes_of(params));
    return {slot.params.address(), moment.picture != nullptr};
}

void RoomStage::upload(const gpu::Commands& cmd, gpu::Buffer& staging, const Image& picture) {
    assert(calibration_ && picture.channels == 4);
    assert(picture.width == calibration_->size.x && picture.height == calibration_->size.y);
    staging.write(gpu::range_bytes(picture.pixels));

    using gpu::Access;
    using Layout = vk::ImageLayout;
    // Shaders of earlier frames may still read the picture before.
    cmd.barrier(Access::ComputeRead, Access::RayTracingRead);
    gpu::transition(cmd.vk(), image_.vk(), Access::RayTracingRead, Layout::eUndefined, Access::TransferWrite,
                    Layout::eTransferDstOptimal);
    cmd->copyBufferToImage(staging.vk(), image_.vk(), Layout::eTransferDstOptimal,
                           vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                               {picture.width, picture.height, 1}));
    gpu::transition(cmd.vk(), image_.vk(), Access::TransferWrite, Layout::eTransferDstOptimal,
                    Access::RayTracingRead, Layout::eShaderReadOnlyOptimal);
    cmd.barrier(Access::RayTracingRead, Access::ComputeRead);
}

}  // namespace foveray::passthrough
