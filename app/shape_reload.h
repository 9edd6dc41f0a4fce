#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "render/ray_pipeline.h"
#include "render/user_shapes/shape_store.h"

namespace foveray::app {

/// Watches the files of users' shapes. When one was saved, it is probed and compiled and a pipeline made with
/// it, on a thread of its own; what cannot be shown is logged, and the last good shape stays.
class ShapeReload {
  public:
    /// Called on the other thread.
    using MakePipeline = std::function<render::RayPipeline(const render::UserShaders&)>;

    /// All must outlive this. `shaders`: of the scene's files as they were loaded. Without user shapes
    /// nothing happens.
    ShapeReload(const scene::Scene& scene, user_shapes::ShapeStore& store, render::UserShaders shaders,
                MakePipeline make_pipeline);
    /// Waits for a probe that runs.
    ~ShapeReload();

    /// A pipeline with what has changed, once it is ready.
    std::optional<render::RayPipeline> take();

  private:
    struct File {
        std::filesystem::path path;
        std::string text;   // as it was last tried
        std::string stamp;  // of the last look: when and what was saved
        bool settled = true;
    };

    void watch();
    bool saved(File& file) const;
    void reload(scene::UserShapeId id);

    const scene::Scene& scene_;
    user_shapes::ShapeStore& store_;
    render::UserShaders shaders_;  // the last good ones
    MakePipeline make_pipeline_;
    std::vector<File> files_;  // by scene::UserShapeId

    std::mutex mutex_;
    std::condition_variable wake_;
    bool stop_ = false;
    std::optional<render::RayPipeline> ready_;
    std::thread thread_;
};

}  // namespace foveray::app
