#pragma once

#include <filesystem>

#include "base/frame.h"
#include "base/session.h"
#include "base/staged_folder.h"

namespace foveray::app {

/// Keeps what a headset reports, frame by frame, and writes it as a session folder.
class SessionRecorder {
  public:
    /// `header`: headset and inputs; the rate comes from the frames, its streams are ignored. Throws
    /// Fault(BadInput) when the folder cannot be made.
    SessionRecorder(const std::filesystem::path& folder, Session header);

    void add(const Frame& frame);
    /// Writes the folder; an empty recording leaves nothing.
    void finish();

  private:
    StagedFolder folder_;
    Session session_;
};

}  // namespace foveray::app
