#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/frame_loop.h"
#include "app/inputs.h"

namespace foveray::app {

/// Watches the files of the scene that is shown. When one is saved, the scene is read again and made ready
/// beside the running frames; saved files of users' shapes alone leave the rest as it is. What cannot be
/// shown is logged with the reason, and the last good scene stays.
class SceneReload {
  public:
    /// `inputs`: what `loop` shows now. Both must outlive this, and nobody else may use the inputs' shapes
    /// meanwhile.
    SceneReload(Inputs& inputs, FrameLoop& loop);
    /// Waits for what is being made ready.
    ~SceneReload();

    /// Between two frames: shows a changed scene, if one is ready, and returns whether there was one.
    bool show();

  private:
    struct File {
        std::filesystem::path path;
        std::string stamp;  // of the last look: when and what was saved
        bool settled = true;
    };

    void watch_files();
    void watch(const std::vector<std::filesystem::path>& files);
    static bool saved(File& file);
    void reload(std::vector<std::filesystem::path> changed);
    void reload_shapes(const std::vector<std::filesystem::path>& changed);
    void reload_scene(const std::vector<std::filesystem::path>& changed);
    void make_ready(std::shared_ptr<const scene::Scene> scene, render::UserShaders shaders,
                    const std::vector<std::filesystem::path>& changed);
    std::optional<scene::UserShapeId> shape_of(const std::filesystem::path& file) const;

    std::filesystem::path scene_file_;
    user_shapes::ShapeStore& store_;
    FrameLoop& loop_;
    // The last good ones.
    std::shared_ptr<const scene::Scene> scene_;
    render::UserShaders shaders_;
    std::vector<std::string> shape_texts_;  // by scene::UserShapeId, as they were last tried
    std::vector<File> files_;
    std::vector<std::filesystem::path> changed_;  // not yet read again
    std::vector<std::filesystem::path> failed_;   // read, but something was wrong with them or others
    /// Scenes that were shown, which frames may still use: freed here, where it holds no frame up.
    std::vector<std::shared_ptr<const void>> shown_;

    std::mutex mutex_;
    std::condition_variable wake_;
    std::atomic<bool> stop_ = false;
    std::optional<render::LiveScene::Next> ready_;
    std::vector<std::filesystem::path> ready_files_;  // that it was made for
    std::thread thread_;
};

}  // namespace foveray::app
