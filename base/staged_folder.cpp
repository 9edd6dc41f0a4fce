#include "base/staged_folder.h"

#include <unistd.h>

#include "base/error.h"

namespace foveray {
namespace fs = std::filesystem;

StagedFolder::StagedFolder(fs::path target, const std::string& marker)
    : target_(fs::absolute(std::move(target)).lexically_normal()) {
    if (target_.filename().empty()) target_ = target_.parent_path();
    if (fs::exists(target_)) {
        const bool ours = !marker.empty() && fs::exists(target_ / marker);
        if (!fs::is_directory(target_) || (!ours && !fs::is_empty(target_))) {
            throw_bad_input(target_.string(), "exists and is not an earlier result of foveray",
                            "name another --out, or remove it");
        }
    }
    staging_ = target_;
    staging_ += ".partial-" + std::to_string(::getpid());
    std::error_code error;
    fs::remove_all(staging_, error);
    if (!fs::create_directories(staging_, error)) {
        throw_bad_input(target_.string(), "cannot be created: " + error.message(), "name another --out");
    }
}

StagedFolder::~StagedFolder() {
    std::error_code ignored;
    if (!committed_) fs::remove_all(staging_, ignored);
}

void StagedFolder::commit() {
    std::error_code error;
    fs::remove_all(target_, error);
    fs::rename(staging_, target_, error);
    if (error)
        throw_bad_input(target_.string(), "cannot be replaced: " + error.message(), "name another --out");
    committed_ = true;
}

}  // namespace foveray
