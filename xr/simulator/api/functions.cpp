#include "xr/simulator/api/functions.h"

#include <algorithm>
#include <array>

#include "xr/simulator/api/failing_calls.h"

namespace foveray::simulator {
namespace {

enum class FunctionId {
#define FOVERAY_ID(symbol, feature) symbol,
    FOVERAY_SIMULATOR_FUNCTIONS(FOVERAY_ID)
#undef FOVERAY_ID
};

const FunctionEntry& entry_of(FunctionId id);

template <typename Handle>
constexpr Owner owner_of() {
    constexpr bool is_session = std::is_same_v<Handle, XrSession> || std::is_same_v<Handle, XrSpace> ||
                                std::is_same_v<Handle, XrSwapchain> ||
                                std::is_same_v<Handle, XrHandTrackerEXT>;
    constexpr bool is_instance = std::is_same_v<Handle, XrInstance> || std::is_same_v<Handle, XrActionSet> ||
                                 std::is_same_v<Handle, XrAction> ||
                                 std::is_same_v<Handle, XrDebugUtilsMessengerEXT>;
    return is_session ? Owner::Session : is_instance ? Owner::Instance : Owner::None;
}

/// What clients call.
template <FunctionId id, auto function>
struct Entry;
template <FunctionId id, typename First, typename... Others, XrResult(XRAPI_PTR* function)(First, Others...)>
struct Entry<id, function> {
    static constexpr Owner owner = owner_of<First>();

    static XRAPI_ATTR XrResult XRAPI_CALL call(First first, Others... others) noexcept {
        std::uint64_t handle = 0;
        if constexpr (owner != Owner::None) handle = reinterpret_cast<std::uint64_t>(first);
        if (owner == Owner::None || calls_may_fail) {
            if (const auto failure = scripted_failure(entry_of(id), handle)) return *failure;
        }
        const XrResult result = function(first, others...);
        return calls_may_fail ? with_notice(entry_of(id), handle, result) : result;
    }
};

const auto& table() {
#define FOVERAY_ENTRY(symbol, feature)                                                                      \
    FunctionEntry{#symbol, reinterpret_cast<PFN_xrVoidFunction>(&Entry<FunctionId::symbol, &symbol>::call), \
                  feature, Entry<FunctionId::symbol, &symbol>::owner},
    static const std::array entries{FOVERAY_SIMULATOR_FUNCTIONS(FOVERAY_ENTRY)};
#undef FOVERAY_ENTRY
    return entries;
}

const FunctionEntry& entry_of(FunctionId id) { return table()[static_cast<std::size_t>(id)]; }

}  // namespace

const FunctionEntry* find_function(std::string_view name) {
    const auto found = std::ranges::find(table(), name, &FunctionEntry::name);
    return found != table().end() ? &*found : nullptr;
}

}  // namespace foveray::simulator
