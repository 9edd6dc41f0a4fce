#include "xr/simulator/handles.h"

#include <map>
#include <mutex>
#include <shared_mutex>
#include <vector>

namespace foveray::simulator {
namespace {

struct Entry {
    std::shared_ptr<Object> object;
    XrObjectType type;
    std::uint64_t parent;
};

struct Registry {
    std::shared_mutex mutex;
    std::uint64_t next_id = 0x5f00'0000'0000'0000;  // far from what a client might make up
    std::map<std::uint64_t, Entry> entries;         // by age, so that children stand behind their parents
};

/// Objects that a program leaves behind are not freed: they must not reach for its Vulkan device while it
/// exits.
struct Keeper {
    Registry& registry = *new Registry;

    ~Keeper() {
        if (registry.entries.empty()) delete &registry;
    }
};

Registry& registry() {
    static Keeper keeper;
    return keeper.registry;
}

}  // namespace

std::uint64_t register_object(std::shared_ptr<Object> object, XrObjectType type, std::uint64_t parent) {
    Registry& r = registry();
    const std::unique_lock lock(r.mutex);
    verify(parent == 0 || r.entries.contains(parent), XR_ERROR_HANDLE_INVALID);
    const std::uint64_t id = r.next_id++;
    object->id_ = id;
    r.entries.emplace(id, Entry{std::move(object), type, parent});
    return id;
}

std::shared_ptr<Object> find_object(std::uint64_t id, XrObjectType type) {
    Registry& r = registry();
    const std::shared_lock lock(r.mutex);
    const auto found = r.entries.find(id);
    if (found == r.entries.end() || found->second.type != type) return nullptr;
    object_of_call = id;
    return found->second.object;
}

std::shared_ptr<Object> find_root(std::uint64_t id) {
    Registry& r = registry();
    const std::shared_lock lock(r.mutex);
    auto found = r.entries.find(id);
    while (found != r.entries.end() && found->second.parent != 0)
        found = r.entries.find(found->second.parent);
    return found != r.entries.end() ? found->second.object : nullptr;
}

std::shared_ptr<Object> find_ancestor(std::uint64_t id, XrObjectType type) {
    Registry& r = registry();
    const std::shared_lock lock(r.mutex);
    auto found = r.entries.find(id);
    while (found != r.entries.end() && found->second.type != type)
        found = r.entries.find(found->second.parent);
    return found != r.entries.end() ? found->second.object : nullptr;
}

bool destroy_object(std::uint64_t id, XrObjectType type) {
    std::vector<std::shared_ptr<Object>> doomed;  // parents first
    {
        Registry& r = registry();
        const std::unique_lock lock(r.mutex);
        const auto found = r.entries.find(id);
        if (found == r.entries.end() || found->second.type != type) return false;
        std::vector<std::uint64_t> removed{id};
        doomed.push_back(std::move(found->second.object));
        for (auto it = r.entries.erase(found); it != r.entries.end();) {
            if (std::find(removed.begin(), removed.end(), it->second.parent) == removed.end()) {
                ++it;
                continue;
            }
            removed.push_back(it->first);
            doomed.push_back(std::move(it->second.object));
            it = r.entries.erase(it);
        }
    }
    for (const auto& object : doomed) object->on_destroy();
    while (!doomed.empty()) doomed.pop_back();
    return true;
}

}  // namespace foveray::simulator
