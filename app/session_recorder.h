#pragma once

#include <filesystem>
#include <string>

#include "base/frame.h"
#include "base/headset_profile.h"
#include "base/session.h"
#include "base/staged_folder.h"

namespace foveray::app {

/// Keeps what a headset reports, frame by frame, and writes it as a session folder.
class SessionRecorder {
  public:
    /// `header`: headset and inputs; the rate comes from the frames, its streams are ignored. Its headset may
    /// be empty until `set_headset`. Throws Fault(BadInput) when the folder cannot be made.
    SessionRecorder(const std::filesystem::path& folder, Session header);

    /// Throws Fault(BadInput) when no recording could be written there. Leaves nothing.
    static void require_place(const std::filesystem::path& folder) { StagedFolder(folder, ""); }

    bool knows_headset() const { return !session_.headset.empty(); }
    /// A headset that has no profile of its own: it goes into the folder.
    void set_headset(const HeadsetProfile& profile);
    /// Where the head's pose is not known it has no sample; events say so, and where its position or
    /// orientation is not measured.
    void add(const Frame& frame);
    /// What a frame was traced with. Kept where it differs from the frame before.
    void add(const Session::QualitySample& quality);
    /// The frame is the first that shows the scene as it was edited meanwhile.
    void add_scene_change(const Frame& frame);
    /// Writes the folder; a recording without frames or without a headset leaves nothing.
    void finish();

  private:
    void note(Nanoseconds time, bool& was_tracked, bool is_tracked, const std::string& what);

    StagedFolder folder_;
    Session session_;
    Nanoseconds period_ = 0;  // of the display
    bool head_tracked_ = true, position_tracked_ = true, orientation_tracked_ = true;  // in the last frame
};

}  // namespace foveray::app
