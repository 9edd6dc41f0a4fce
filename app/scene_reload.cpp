#include "app/scene_reload.h"

#include <algorithm>
#include <chrono>
#include <sys/stat.h>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "base/error.h"
#include "base/log.h"

namespace foveray::app {
namespace {

namespace fs = std::filesystem;

constexpr auto period = std::chrono::milliseconds(250);

/// Differs when the file does; empty while there is none, as when an editor puts a new file in its place.
std::string stamp_of(const fs::path& file) {
    struct stat info {};
    if (::stat(file.c_str(), &info) != 0) return "";
    return fmt::format("{} {} {} {}", info.st_mtim.tv_sec, info.st_mtim.tv_nsec, info.st_size, info.st_ino);
}

std::vector<std::string> texts_of(const scene::Scene& scene) {
    std::vector<std::string> texts;
    for (const scene::UserShape& shape : scene.user_shapes) texts.push_back(shape.code.text);
    return texts;
}

}  // namespace

SceneReload::SceneReload(Inputs& inputs, FrameLoop& loop)
    : scene_file_(inputs.scene_file),
      store_(inputs.shapes),
      loop_(loop),
      scene_(inputs.scene),
      shaders_(inputs.user_shaders),
      shape_texts_(texts_of(*inputs.scene)) {
    watch(inputs.scene_files);
    shown_.push_back(loop.content());
    inputs.scene.reset();  // it goes when it is no longer shown
    thread_ = std::thread([this] { watch_files(); });
}

SceneReload::~SceneReload() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

bool SceneReload::show() {
    const std::lock_guard lock(mutex_);
    if (!ready_) return false;
    loop_.show(std::move(*ready_));
    ready_.reset();
    for (const fs::path& file : ready_files_) log::info("{}: reloaded", file.string());
    return true;
}

void SceneReload::watch_files() {
    for (;;) {
        for (File& file : files_) {
            if (saved(file)) changed_.push_back(file.path);
        }
        // Several files may be saved together.
        const bool settled = std::ranges::all_of(files_, &File::settled);
        if (!changed_.empty() && settled) reload(std::exchange(changed_, {}));
        std::erase_if(shown_, [](const auto& content) { return content.use_count() == 1; });
        std::unique_lock lock(mutex_);
        if (wake_.wait_for(lock, period, [this] { return stop_.load(); })) return;
        // One at a time: until the frames have taken the last one, there is no other.
        while (ready_ && !stop_) wake_.wait_for(lock, period);
        if (stop_) return;
    }
}

/// Also these, from how they are now.
void SceneReload::watch(const std::vector<fs::path>& files) {
    for (const fs::path& path : files) {
        if (std::ranges::find(files_, path, &File::path) == files_.end()) {
            files_.push_back({path, stamp_of(path), true});
        }
    }
}

/// It has another stamp than at first, and the same as at the last look: the editor is done.
bool SceneReload::saved(File& file) {
    const std::string stamp = stamp_of(file.path);
    if (stamp.empty()) {  // gone; when it is back it counts as saved
        file.stamp.clear();
        file.settled = true;
        return false;
    }
    const bool settled = stamp == file.stamp;
    const bool is_new = settled && !file.settled;
    file.stamp = stamp;
    file.settled = settled;
    return is_new;
}

std::optional<scene::UserShapeId> SceneReload::shape_of(const fs::path& file) const {
    const auto found = std::ranges::find(scene_->user_shapes, file,
                                         [](const scene::UserShape& shape) { return shape.code.file; });
    if (found == scene_->user_shapes.end()) return std::nullopt;
    return static_cast<scene::UserShapeId>(found - scene_->user_shapes.begin());
}

void SceneReload::reload(std::vector<fs::path> changed) {
    // What was saved before a fault was mended elsewhere is still to be shown.
    for (fs::path& file : std::exchange(failed_, {})) {
        if (std::ranges::find(changed, file) == changed.end()) changed.push_back(std::move(file));
    }
    const bool only_shapes =
        std::ranges::all_of(changed, [&](const fs::path& file) { return shape_of(file).has_value(); });
    try {
        only_shapes ? reload_shapes(changed) : reload_scene(changed);
    } catch (const std::exception& e) {
        // To be tried again when it is saved again, even if nothing is changed.
        for (std::string& text : shape_texts_) text.clear();
        failed_ = changed;
        log::error("{}; the last good {} stays", e.what(), only_shapes ? "shape" : "scene");
    }
}

void SceneReload::reload_shapes(const std::vector<fs::path>& changed) {
    render::UserShaders shaders = shaders_;
    std::vector<fs::path> really;
    for (const fs::path& file : changed) {
        if (stop_) return;
        const scene::UserShapeId id = *shape_of(file);
        const scene::UserShapeCode code = scene::read_user_shape(file);
        if (code.text == shape_texts_[id]) continue;
        shape_texts_[id] = code.text;
        shaders[id] = store_.prepare(*scene_, id, code);
        really.push_back(file);
    }
    if (!really.empty()) make_ready(scene_, std::move(shaders), really);
}

void SceneReload::reload_scene(const std::vector<fs::path>& changed) {
    std::vector<fs::path> files;
    std::shared_ptr<const scene::Scene> scene;
    try {
        scene = std::make_shared<const scene::Scene>(scene::load_scene(scene_file_, &files));
    } catch (...) {
        watch(files);  // the fault may be mended there
        throw;
    }
    watch(files);  // what is saved while it is made ready shall be seen
    if (stop_) return;
    render::UserShaders shaders = store_.prepare(*scene);
    if (stop_) return;
    std::vector<std::string> texts = texts_of(*scene);
    make_ready(std::move(scene), std::move(shaders), changed);
    shape_texts_ = std::move(texts);
    std::erase_if(files_,
                  [&](const File& file) { return std::ranges::find(files, file.path) == files.end(); });
}

void SceneReload::make_ready(std::shared_ptr<const scene::Scene> scene, render::UserShaders shaders,
                             const std::vector<fs::path>& changed) {
    render::LiveScene::Next next = loop_.prepare(scene, shaders);
    if (next.content()) shown_.push_back(next.content());
    scene_ = std::move(scene);
    shaders_ = std::move(shaders);
    const std::lock_guard lock(mutex_);
    ready_ = std::move(next);
    ready_files_ = changed;
}

}  // namespace foveray::app
