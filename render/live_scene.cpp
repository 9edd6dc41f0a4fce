#include "render/live_scene.h"

#include <utility>

namespace foveray::render {

LiveScene::Content::Content(const gpu::Device& device, gpu::TextureTable& textures, std::uint32_t slots,
                            std::shared_ptr<const scene::Scene> shown, const RayPipeline& pipeline,
                            vk::DeviceSize portion, MeshStore& store)
    : scene(std::move(shown)),
      animator(*scene),
      gpu(device, textures, *scene, slots, portion, &store),
      accel(device, gpu, pipeline, slots, portion) {}

LiveScene::LiveScene(const gpu::Device& device, gpu::TextureTable& textures, std::uint32_t slots,
                     std::shared_ptr<const scene::Scene> scene, const UserShaders& users)
    : device_(device),
      textures_(textures),
      slots_(slots),
      pipeline_(device, textures, slots, *scene, users),
      content_(
          std::make_shared<Content>(device, textures, slots, scene, pipeline_, gpu::whole_portion, store_)) {
    content_->accel.fill_table(pipeline_);
}

LiveScene::Next LiveScene::prepare(std::shared_ptr<const scene::Scene> scene,
                                   const UserShaders& users) const {
    Next next;
    if (!pipeline_.suits(*scene, users)) next.pipeline_.emplace(device_, textures_, slots_, *scene, users);
    if (scene == content_->scene) return next;
    next.content_ =
        std::make_shared<Content>(device_, textures_, slots_, std::move(scene),
                                  next.pipeline_ ? *next.pipeline_ : pipeline_, gpu::small_portion, store_);
    return next;
}

void LiveScene::show(gpu::FrameRing& ring, Next next) {
    if (next.pipeline_) {
        std::swap(pipeline_, *next.pipeline_);
        ring.release(std::move(*next.pipeline_));
    }
    if (next.content_) {
        std::swap(content_, next.content_);
        ring.release(std::move(next.content_));
    }
    content_->accel.fill_table(pipeline_);
}

}  // namespace foveray::render
