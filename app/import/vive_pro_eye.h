#pragma once

#include <filesystem>
#include <vector>

#include "base/session.h"

namespace foveray::app {

/// Log of a trial with an HTC Vive Pro Eye, recorded by Unity UXF trackers as in Schuetz, Baltaretu and
/// Fiehler, "Realistic 3D objects and scenes", Journal of Vision 24(7):10, 2024: two files on one clock, in
/// any order.
///   Eye_gaze_*.csv  time [s], ori_xyz [m] and dir_xyz (unit) in the head's frame, pupil_l, pupil_r [mm]
///   VR_move_*.csv   time [s], head and controllers: pos_xyz [m], rot_xyz [Euler degrees]
/// Unity is left-handed with +z forward; the session is right-handed with -z forward, starting at time 0.
/// A gaze row that repeats the one before carries no new measurement and is left out; rows without gaze
/// (origin zero, direction zero or straight ahead; both pupils unseen) are invalid. A controller at (0, 0, 0)
/// was not tracked, and one that never was is left out. The log's grab and trigger columns name no hand: they
/// are the right controller's when that was tracked, else the left one's. Throws Fault(BadInput) naming file
/// and line.
Session read_vive_pro_eye(const std::vector<std::filesystem::path>& files);

/// The rotation that Unity writes as Euler angles in degrees: about z, then x, then y, each about the fixed
/// axes of the left-handed frame; returned in the right-handed one.
quat from_unity_euler(dvec3 degrees);

}  // namespace foveray::app
