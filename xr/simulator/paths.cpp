#include "xr/simulator/paths.h"

#include <algorithm>

#include "xr/simulator/api/verify.h"

namespace foveray::simulator {

bool is_well_formed_name(std::string_view text) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    };
    return !text.empty() && std::ranges::all_of(text, allowed) &&
           text.find_first_not_of('.') != std::string_view::npos;
}

bool is_well_formed_path(std::string_view text) {
    if (text.size() < 2 || text.size() >= XR_MAX_PATH_LENGTH || text.front() != '/') return false;
    while (!text.empty()) {
        text.remove_prefix(1);
        const std::size_t end = std::min(text.find('/'), text.size());
        if (!is_well_formed_name(text.substr(0, end))) return false;
        text.remove_prefix(end);
    }
    return true;
}

XrPath PathTable::atom(std::string_view text) {
    verify(is_well_formed_path(text), XR_ERROR_PATH_FORMAT_INVALID);
    const std::lock_guard lock(mutex_);
    const auto found = atoms_.find(text);
    if (found != atoms_.end()) return found->second;
    texts_.emplace_back(text);
    return atoms_[texts_.back()] = last_invalid_atom + texts_.size();
}

std::string PathTable::text(XrPath path) const {
    const std::lock_guard lock(mutex_);
    verify(path > last_invalid_atom && path - last_invalid_atom <= texts_.size(), XR_ERROR_PATH_INVALID);
    return texts_[path - last_invalid_atom - 1];
}

}  // namespace foveray::simulator
