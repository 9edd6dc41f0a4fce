#include "xr/simulator/functions.h"

#include <algorithm>
#include <array>

namespace foveray::simulator {

const FunctionEntry* find_function(std::string_view name) {
#define FOVERAY_ENTRY(symbol, feature) \
    FunctionEntry{#symbol, reinterpret_cast<PFN_xrVoidFunction>(&symbol), feature},
    static const auto table = [] {
        std::array entries{FOVERAY_SIMULATOR_FUNCTIONS(FOVERAY_ENTRY)};
        std::ranges::sort(entries, {}, &FunctionEntry::name);
        return entries;
    }();
#undef FOVERAY_ENTRY
    const auto found = std::ranges::lower_bound(table, name, {}, &FunctionEntry::name);
    return found != table.end() && found->name == name ? &*found : nullptr;
}

}  // namespace foveray::simulator
