#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>
#include <typeindex>
#include <vector>

#include "tests/fuzz/random.h"

namespace foveray::fuzz {

/// All handles that calls gave, whether they still live or not, for all threads.
class HandlePool {
  public:
    template <typename Handle>
    void add(Handle handle) {
        const std::lock_guard lock(mutex_);
        auto& list = handles_[typeid(Handle)];
        // The newest are the most likely to live.
        if (list.size() >= 64) list.erase(list.begin());
        list.push_back(reinterpret_cast<std::uint64_t>(handle));
        ++made_[typeid(Handle)];
    }
    /// How many were ever added.
    template <typename Handle>
    std::uint64_t made() const {
        const std::lock_guard lock(mutex_);
        const auto found = made_.find(typeid(Handle));
        return found != made_.end() ? found->second : 0;
    }
    template <typename Handle>
    void remember_dead(Handle handle) {
        const std::lock_guard lock(mutex_);
        std::erase(handles_[typeid(Handle)], reinterpret_cast<std::uint64_t>(handle));
        if (dead_.size() >= 256) dead_.erase(dead_.begin());
        dead_.push_back(reinterpret_cast<std::uint64_t>(handle));
    }

    /// Mostly of that type; sometimes destroyed, of another type, null or made up.
    template <typename Handle>
    Handle pick(Random& random) const {
        const std::lock_guard lock(mutex_);
        const auto found = handles_.find(typeid(Handle));
        if (found != handles_.end() && !found->second.empty() && random.chance(93)) {
            // A few at the end are used much, so that calls meet.
            const std::size_t count = std::min<std::size_t>(found->second.size(), random.chance(80) ? 3 : 64);
            return as<Handle>(found->second[found->second.size() - 1 - random.below(count)]);
        }
        if (!dead_.empty() && random.chance(40)) return as<Handle>(random.pick(dead_));
        if (random.chance(40)) {
            for (const auto& [type, list] : handles_) {
                if (!list.empty() && random.chance(30)) return as<Handle>(random.pick(list));
            }
        }
        return as<Handle>(random.chance(50) ? random.bits() : random.below(3));
    }
    template <typename Handle>
    std::vector<Handle> all() const {
        const std::lock_guard lock(mutex_);
        std::vector<Handle> list;
        if (const auto found = handles_.find(typeid(Handle)); found != handles_.end()) {
            for (const std::uint64_t value : found->second) list.push_back(as<Handle>(value));
        }
        return list;
    }

  private:
    template <typename Handle>
    static Handle as(std::uint64_t value) {
        return reinterpret_cast<Handle>(value);
    }

    mutable std::mutex mutex_;
    std::map<std::type_index, std::vector<std::uint64_t>> handles_;
    std::vector<std::uint64_t> dead_;
    std::map<std::type_index, std::uint64_t> made_;
};

}  // namespace foveray::fuzz
