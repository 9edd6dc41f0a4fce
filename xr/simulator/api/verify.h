#pragma once

#include <algorithm>
#include <cstdint>
#include <source_location>
#include <span>
#include <string_view>

#include <openxr/openxr.h>

#include "xr/simulator/api/call_cost.h"

/// What the API files share: arguments are verified or the call is refused, and nothing thrown leaves the
/// library.
namespace foveray::simulator {

/// The call is refused with an OpenXR error; caught by `guarded`.
struct Refusal {
    XrResult result;
};

inline void verify(bool holds, XrResult otherwise = XR_ERROR_VALIDATION_FAILURE) {
    if (!holds) throw Refusal{otherwise};
}

/// Prints "foveray simulator: MESSAGE" to standard error.
void report(std::string_view message);
/// The result that stands for the exception being handled.
XrResult result_of_current_exception();

/// The object that the running call of this thread looked up last; 0 before any.
inline thread_local std::uint64_t object_of_call = 0;
/// Tells the debug messengers of that object's instance. `signature` is the entry point's.
void tell_refusal(const char* signature, XrResult result) noexcept;

/// Runs the body of an entry point. The body returns nothing for XR_SUCCESS, or an XrResult.
template <typename Body>
XrResult guarded(Body&& body, std::source_location entry = std::source_location::current()) noexcept {
    const call_cost::Scope cost;
    object_of_call = 0;
    try {
        if constexpr (std::is_void_v<decltype(body())>) {
            body();
            return XR_SUCCESS;
        } else {
            return body();
        }
    } catch (...) {
        const XrResult result = result_of_current_exception();
        tell_refusal(entry.function_name(), result);
        return result;
    }
}

template <typename Structure>
void verify_structure(const Structure* structure, XrStructureType type) {
    verify(structure != nullptr && structure->type == type);
}

template <typename Structure>
void verify_optional_structure(const Structure* structure, XrStructureType type) {
    verify(structure == nullptr || structure->type == type);
}

/// The first structure of that type in a `next` chain, or nullptr.
template <typename Structure>
const Structure* find_input(const void* next, XrStructureType type) {
    const auto* base = static_cast<const XrBaseInStructure*>(next);
    while (base && base->type != type) base = base->next;
    return reinterpret_cast<const Structure*>(base);
}

template <typename Structure>
Structure* find_output(void* next, XrStructureType type) {
    auto* base = static_cast<XrBaseOutStructure*>(next);
    while (base && base->type != type) base = base->next;
    return reinterpret_cast<Structure*>(base);
}

/// OpenXR's two-call idiom: capacity 0 asks for the count. `assign(target, index)` fills one element.
template <typename Target, typename Assign>
void enumerate(std::uint32_t count, std::uint32_t capacity, std::uint32_t* count_output, Target* targets,
               Assign assign) {
    verify(count_output != nullptr);
    *count_output = count;
    if (capacity == 0) return;
    verify(capacity >= count, XR_ERROR_SIZE_INSUFFICIENT);
    verify(targets != nullptr || count == 0);
    for (std::uint32_t i = 0; i < count; ++i) assign(targets[i], i);
}

template <typename Value>
void enumerate_values(std::span<const Value> values, std::uint32_t capacity, std::uint32_t* count_output,
                      Value* targets) {
    enumerate(static_cast<std::uint32_t>(values.size()), capacity, count_output, targets,
              [&](Value& target, std::uint32_t i) { target = values[i]; });
}

/// The same for text; counts include the terminating zero.
void enumerate_text(std::string_view text, std::uint32_t capacity, std::uint32_t* count_output, char* target);

/// Copies `text` cut to the array's size, zero terminated.
template <std::size_t Size>
void copy_text(char (&target)[Size], std::string_view text) {
    const std::size_t length = std::min(text.size(), Size - 1);
    std::copy_n(text.data(), length, target);
    target[length] = '\0';
}

/// The text of a fixed array that must hold a terminating zero; refuses with `otherwise`.
template <std::size_t Size>
std::string_view fixed_text(const char (&array)[Size], XrResult otherwise) {
    const char* const end = std::find(array, array + Size, '\0');
    verify(end != array + Size, otherwise);
    return {array, static_cast<std::size_t>(end - array)};
}

}  // namespace foveray::simulator
