#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.h"

namespace foveray {

/// What a JSON document does wrong at one place, in plain words.
struct Complaint {
    std::string what;    // "must be at least 0, not -1"
    std::string remedy;  // "correct the value"
};

/// Puts in words how the value at `place` (keys and indices from the document's root) breaks `schema`, which
/// it is known to break. Empty when it is by a keyword that foveray's schemas do not use.
std::optional<Complaint> complaint_at(const Json& schema, const Json& document,
                                      const std::vector<std::string>& place);

}  // namespace foveray
