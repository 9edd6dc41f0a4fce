#include "app/shape_reload.h"

#include <chrono>
#include <sys/stat.h>

#include <spdlog/fmt/fmt.h>

#include "base/error.h"
#include "base/log.h"

namespace foveray::app {
namespace {

constexpr auto period = std::chrono::milliseconds(250);

/// Differs when the file does; empty while there is none, as when an editor puts a new file in its place.
std::string stamp_of(const std::filesystem::path& file) {
    struct stat info {};
    if (::stat(file.c_str(), &info) != 0) return "";
    return fmt::format("{} {} {} {}", info.st_mtim.tv_sec, info.st_mtim.tv_nsec, info.st_size, info.st_ino);
}

}  // namespace

ShapeReload::ShapeReload(const scene::Scene& scene, user_shapes::ShapeStore& store,
                         render::UserShaders shaders, MakePipeline make_pipeline)
    : scene_(scene), store_(store), shaders_(std::move(shaders)), make_pipeline_(std::move(make_pipeline)) {
    for (const scene::UserShape& shape : scene.user_shapes)
        files_.push_back({shape.code.file, shape.code.text, "", true});
    if (!files_.empty()) thread_ = std::thread([this] { watch(); });
}

ShapeReload::~ShapeReload() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
}

std::optional<render::RayPipeline> ShapeReload::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(ready_, std::nullopt);
}

void ShapeReload::watch() {
    for (;;) {
        for (scene::UserShapeId id = 0; id < files_.size(); ++id) {
            if (saved(files_[id])) reload(id);
        }
        std::unique_lock lock(mutex_);
        if (wake_.wait_for(lock, period, [this] { return stop_; })) return;
    }
}

/// It has another stamp than at first, and the same as at the last look: the editor is done.
bool ShapeReload::saved(File& file) const {
    const std::string stamp = stamp_of(file.path);
    if (stamp.empty()) return false;
    const bool settled = stamp == file.stamp;
    const bool is_new = settled && !file.settled;
    file.stamp = stamp;
    file.settled = settled;
    return is_new;
}

void ShapeReload::reload(scene::UserShapeId id) {
    File& file = files_[id];
    try {
        const scene::UserShapeCode code = scene::read_user_shape(file.path);
        if (code.text == file.text) return;
        file.text = code.text;
        render::UserShaders shaders = shaders_;
        shaders[id] = store_.prepare(scene_, id, code);
        render::RayPipeline made = make_pipeline_(shaders);
        shaders_ = std::move(shaders);
        const std::lock_guard lock(mutex_);
        ready_ = std::move(made);
        log::info("{}: reloaded", file.path.string());
    } catch (const std::exception& e) {
        file.text.clear();  // to be tried again when it is saved again, even if nothing is changed
        log::error("{}; the last good shape stays", e.what());
    }
}

}  // namespace foveray::app
