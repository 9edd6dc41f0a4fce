#pragma once

#include <filesystem>
#include <string>

namespace foveray {

/// A folder that appears complete or not at all: written under a temporary name beside its target, renamed by
/// commit(), removed by the destructor without it.
class StagedFolder {
  public:
    /// `marker`: the file by which an earlier result of the same kind is known, and may be replaced; empty:
    /// nothing may be replaced. Throws Fault(BadInput) when the parent cannot be written, or when `target`
    /// exists, is not empty and lacks it.
    StagedFolder(std::filesystem::path target, const std::string& marker);
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
