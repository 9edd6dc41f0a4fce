#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <openxr/openxr.h>

namespace foveray::simulator {

/// Atoms for path strings, one table an instance. Safe to use from any thread.
class PathTable {
  public:
    /// Refuses with XR_ERROR_PATH_FORMAT_INVALID.
    XrPath atom(std::string_view text);
    /// Refuses with XR_ERROR_PATH_INVALID.
    std::string text(XrPath path) const;

  private:
    static constexpr XrPath last_invalid_atom = 0x7a00'0000'0000;  // far from what a client might make up

    mutable std::mutex mutex_;
    std::vector<std::string> texts_;  // by atom - last_invalid_atom - 1
    std::map<std::string, XrPath, std::less<>> atoms_;
};

/// OpenXR 1.0, section 6.2: "/" and components of a-z, 0-9, '-', '_' and '.', none of dots alone.
bool is_well_formed_path(std::string_view text);
/// Section 6.2: a name of one path component, as actions and action sets have.
bool is_well_formed_name(std::string_view text);

}  // namespace foveray::simulator
