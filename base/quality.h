#pragma once

#include <optional>

#include "base/settings.h"

namespace foveray {

/// How much is spent on light, like the switchable modes of HERR (section 3.3), from 1 to 64 shadow samples a
/// hit.
enum class QualityLevel { Low, Medium, High, Best };

/// The level that Settings::quality_level names; empty for "manual" and "automatic".
std::optional<QualityLevel> named_level(const Settings& settings);

/// The settings at a level: shadow and ambient-occlusion samples, probe rays and the depth of second rays.
/// A setting that is not at its default is the user's wish and stays.
Settings with_level(Settings settings, QualityLevel level);

/// As with_level, but only shadow and ambient-occlusion samples: what may change as one looks, since it
/// changes how noisy the picture is and not what it shows.
Settings with_samples_of(Settings settings, QualityLevel level);

}  // namespace foveray
