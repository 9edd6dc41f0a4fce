#pragma once

#include <cstdint>
#include <memory>

#include <openxr/openxr.h>

#include "xr/simulator/api/verify.h"

/// Handles are numbers that are never used twice, so that a garbage or destroyed one is refused and never
/// dereferenced. Safe to use from any thread.
namespace foveray::simulator {

/// What a handle stands for. Children hold their parent by shared_ptr; a call that runs while another thread
/// destroys the handle keeps its object until it returns.
class Object {
  public:
    Object() = default;
    virtual ~Object() = default;
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    /// The handle is gone: wake whoever waits for this object.
    virtual void on_destroy() {}
    std::uint64_t id() const { return id_; }

  private:
    friend std::uint64_t register_object(std::shared_ptr<Object>, XrObjectType, std::uint64_t);
    std::uint64_t id_ = 0;
};

/// parent: id of the object whose destruction destroys this one; 0 for none.
std::uint64_t register_object(std::shared_ptr<Object> object, XrObjectType type, std::uint64_t parent);
/// nullptr when the handle is not alive or of another type.
std::shared_ptr<Object> find_object(std::uint64_t id, XrObjectType type);
/// The instance that an object belongs to; nullptr when it is gone.
std::shared_ptr<Object> find_root(std::uint64_t id);
/// The object itself or the nearest one above it that has that type; nullptr when there is none.
std::shared_ptr<Object> find_ancestor(std::uint64_t id, XrObjectType type);
/// The object and its children. False when there is none.
bool destroy_object(std::uint64_t id, XrObjectType type);

/// T declares `using Handle = XrSession;` and `static constexpr XrObjectType object_type`.
template <typename T>
typename T::Handle handle_of(const T& object) {
    return reinterpret_cast<typename T::Handle>(object.id());
}

template <typename T>
typename T::Handle add_object(std::shared_ptr<T> object, std::uint64_t parent) {
    return reinterpret_cast<typename T::Handle>(register_object(std::move(object), T::object_type, parent));
}

/// Refuses with XR_ERROR_HANDLE_INVALID.
template <typename T>
std::shared_ptr<T> get(typename T::Handle handle) {
    auto object = find_object(reinterpret_cast<std::uint64_t>(handle), T::object_type);
    verify(object != nullptr, XR_ERROR_HANDLE_INVALID);
    return std::static_pointer_cast<T>(std::move(object));
}

template <typename T>
void destroy(typename T::Handle handle) {
    verify(destroy_object(reinterpret_cast<std::uint64_t>(handle), T::object_type), XR_ERROR_HANDLE_INVALID);
}

}  // namespace foveray::simulator
