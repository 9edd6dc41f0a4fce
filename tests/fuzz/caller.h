#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/fuzz/handle_pool.h"
#include "tests/fuzz/random.h"
#include "tests/xr/simulator/direct_runtime.h"
#include "xr/simulator/api/functions.h"

namespace foveray::fuzz {

struct Functions {
#define FOVERAY_MEMBER(name, feature) PFN_##name name = nullptr;
    FOVERAY_SIMULATOR_FUNCTIONS(FOVERAY_MEMBER)
#undef FOVERAY_MEMBER

    /// From an instance that has all extensions; null where they do not bring it.
    explicit Functions(const simulator_tests::DirectRuntime& runtime);
};

extern const std::vector<const char*> extensions;  // of most instances
extern const std::vector<std::string> path_texts;  // known ones and others

/// Makes the arguments of one call after another; they live until `forget`.
class Caller {
  public:
    /// vulkan: nullptr where there is none.
    Caller(std::uint64_t seed, const Functions& functions, HandlePool& shared_handles,
           const XrGraphicsBindingVulkanKHR* vulkan_binding)
        : random(seed), call(functions), handles(shared_handles), vulkan(vulkan_binding) {}

    template <typename Handle>
    Handle handle() {
        return handles.pick<Handle>(random);
    }
    /// An array of zeros.
    template <typename T>
    T* array(std::size_t count) {
        static_assert(std::is_trivially_copyable_v<T>);
        storage_.push_back(std::make_unique<std::byte[]>(std::max<std::size_t>(count, 1) * sizeof(T)));
        return reinterpret_cast<T*>(storage_.back().get());
    }
    /// Mostly with its own type and nothing chained to it.
    template <typename Structure>
    Structure& structure(XrStructureType type) {
        auto& made = *array<Structure>(1);
        made.type = random.chance(97) ? type : static_cast<XrStructureType>(random.below(100));
        if (random.chance(10)) made.next = chain();
        return made;
    }
    /// Sometimes nullptr instead.
    template <typename T>
    T* maybe(T& value) {
        return random.chance(98) ? &value : nullptr;
    }
    template <typename T>
    T* out() {
        return maybe(*array<T>(1));
    }

    /// A value of an enumeration: one of the first few, or anything.
    template <typename Enum>
    Enum enumerant(int count) {
        if (random.chance(97)) return static_cast<Enum>(random.below(static_cast<std::size_t>(count)));
        return static_cast<Enum>(random.pick({-1, 1000, 0x7fffffff, static_cast<int>(random.bits() >> 33)}));
    }
    XrFlags64 flags(XrFlags64 known) { return random.chance(95) ? random.bits() & known : random.bits(); }
    XrPath path();
    XrTime time();
    XrPosef pose();
    XrSystemId system() { return random.chance(97) ? 1 : random.below(5); }
    XrViewConfigurationType view_configuration();
    /// Capacity of an array of at most 64 elements.
    std::uint32_t capacity() {
        return random.chance(30) ? 0 : static_cast<std::uint32_t>(random.below(random.chance(50) ? 5 : 65));
    }
    std::uint32_t small_count() { return static_cast<std::uint32_t>(random.below(4)); }
    /// Writes a name, good or bad, to a fixed array.
    template <std::size_t Size>
    void write_name(char (&target)[Size]) {
        const std::string text = name();
        std::memcpy(target, text.data(), std::min(text.size(), Size));
        if (text.size() < Size) target[text.size()] = '\0';
    }
    std::string name();

    void forget() { storage_.clear(); }

    Random random;
    const Functions& call;
    HandlePool& handles;
    const XrGraphicsBindingVulkanKHR* const vulkan;
    XrTime last_time = 1'000'000'000;

  private:
    /// A structure that some call knows behind another structure, or none does.
    void* chain();

    std::vector<std::unique_ptr<std::byte[]>> storage_;
};

/// Held in calls that may use the Vulkan queue, which sessions of several instances share.
inline std::mutex queue_mutex;

struct Call {
    const char* name;
    int weight;  // how often, relative to the others
    void (*run)(Caller&);
};

std::vector<Call> instance_calls();
std::vector<Call> session_calls();
std::vector<Call> action_calls();
std::vector<Call> extension_calls();

}  // namespace foveray::fuzz
