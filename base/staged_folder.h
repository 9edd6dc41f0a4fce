#pragma once

#include <filesystem>

namespace foveray {

/// A folder that appears complete or not at all: written under a temporary name beside its target, renamed by
/// commit(), removed by the destructor without it.
class StagedFolder {
  public:
    /// Throws Fault(BadInput) when the parent cannot be written, or when `target` exists and was not made by
    /// foveray (has no summary.json or session.json and is not empty).
    explicit StagedFolder(std::filesystem::path target);
    ~StagedFolder();
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    const std::filesystem::path& path() const { return staging_; }
    const std::filesystem::path& target() const { return target_; }
    /// Replaces an earlier result at the target.
    void commit();

  private:
    std::filesystem::path target_, staging_;
    bool committed_ = false;
};

}  // namespace foveray
