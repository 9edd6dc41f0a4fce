#pragma once

#include <memory>
#include <optional>

#include "render/accel_scene.h"
#include "render/gpu_scene.h"
#include "render/ray_pipeline.h"
#include "render/scene/animator.h"

namespace foveray::render {

/// The scene that frames show, on the GPU, and the way to another one without a stall: what another scene
/// needs is made beside the frames, then takes the first one's place between two of them, which is freed when
/// the GPU is done with it. Meshes that both have are neither uploaded nor built a second time.
///
///     auto next = live.prepare(scene, shaders);   // on any thread, a thousand frames long if need be
///     live.show(ring, std::move(next));           // between two frames
class LiveScene {
    struct Content;

  public:
    /// `slots`: frames in flight. Device and table must outlive this. Uploads and waits.
    LiveScene(const gpu::Device& device, gpu::TextureTable& textures, std::uint32_t slots,
              std::shared_ptr<const scene::Scene> scene, const UserShaders& users = {});

    /// A scene that is ready to be shown.
    class Next {
      public:
        /// Keeps the GPU's part of the scene: whoever lets go of it last frees it, which may take a while.
        std::shared_ptr<const void> content() const { return content_; }

      private:
        friend LiveScene;
        std::shared_ptr<Content> content_;     // null: the scene stays
        std::optional<RayPipeline> pipeline_;  // empty: the pipeline stays
    };
    /// On any thread, one at a time, and not beside show(). Works on the GPU in portions, between frames of
    /// other threads, and waits for them. With the scene that is shown only `users`, its users' shapes, are
    /// taken anew. Throws Fault.
    Next prepare(std::shared_ptr<const scene::Scene> scene, const UserShaders& users = {}) const;
    /// Frames from the next one on show it; `ring` is theirs. The scene's animations go on by session time.
    void show(gpu::FrameRing& ring, Next next);

    /// As Next::content(), of the scene that is shown.
    std::shared_ptr<const void> content() const { return content_; }
    const scene::Scene& scene() const { return *content_->scene; }
    scene::SceneAnimator& animator() { return content_->animator; }
    GpuScene& gpu() { return content_->gpu; }
    AccelScene& accel() { return content_->accel; }
    /// Stays where it is: stages may keep references to its tracer.
    RayPipeline& pipeline() { return pipeline_; }

  private:
    struct Content {
        Content(const gpu::Device& device, gpu::TextureTable& textures, std::uint32_t slots,
                std::shared_ptr<const scene::Scene> shown, const RayPipeline& pipeline,
                vk::DeviceSize portion, MeshStore& store);

        std::shared_ptr<const scene::Scene> scene;
        scene::SceneAnimator animator;
        GpuScene gpu;
        AccelScene accel;
    };

    const gpu::Device& device_;
    gpu::TextureTable& textures_;
    std::uint32_t slots_;
    mutable MeshStore store_;  // that prepare() adds to
    RayPipeline pipeline_;
    std::shared_ptr<Content> content_;
};

}  // namespace foveray::render
