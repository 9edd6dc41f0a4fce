#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/settings.h"
#include "passthrough/calibration.h"
#include "passthrough/camera_frame.h"
#include "render/gpu/commands.h"
#include "render/gpu/texture_table.h"
#include "shaders/shared/room.h"

namespace foveray::passthrough {

/// The room on the GPU in one frame.
struct Room {
    vk::DeviceAddress params = 0;  // shared::RoomParams
    bool has_picture = false;
};

/// A frame's moment as the room sees it.
struct RoomMoment {
    CameraFramePtr picture;  // the newest; null before the first or without a camera
    Pose stage_from_head;    // when that picture was captured
    Pose world_from_stage;
};

/// Brings the newest camera picture and what is known of the room to the GPU.
class RoomStage {
  public:
    /// `calibration` is for the camera's picture size; empty without a camera. `surfaces`: real surfaces in
    /// stage space; shaders take the largest shared::MAX_PROXIES of them, the rest is warned about.
    /// `far_distance` in metres: where the picture is taken to be beyond them.
    RoomStage(const gpu::Device& device, gpu::TextureTable& textures, std::uint32_t frames_in_flight,
              const std::optional<Calibration>& calibration, std::span<const shared::RoomProxy> surfaces,
              float far_distance);
    ~RoomStage();
    RoomStage(const RoomStage&) = delete;
    RoomStage& operator=(const RoomStage&) = delete;

    /// Other real surfaces, from the next record() on.
    void set_surfaces(std::span<const shared::RoomProxy> surfaces);

    /// Uploads the picture when it is another one than before. Compute and ray-tracing shaders recorded
    /// afterwards see the result. `slot`: of the frame ring.
    Room record(const gpu::Commands& cmd, std::uint32_t slot, const RoomMoment& moment,
                const Settings& settings);

  private:
    void upload(const gpu::Commands& cmd, gpu::Buffer& staging, const Image& picture);

    struct Slot {
        gpu::Buffer params, staging;
    };
    gpu::TextureTable& textures_;
    std::optional<Calibration> calibration_;
    shared::RoomParams params_{};  // what stays the same; the rest is filled in a frame
    std::vector<Slot> slots_;
    gpu::Image image_;
    std::uint32_t texture_ = shared::NO_PICTURE;
    CameraFramePtr uploaded_;
};

/// The lens and place of a camera as shaders take them; `stage_from_head` at capture time. Other members
/// stay.
void fill_camera(shared::RoomParams& params, const Calibration& calibration, const Pose& stage_from_head);

}  // namespace foveray::passthrough
