#pragma once

#include <memory>
#include <variant>

#include <openxr/openxr.h>

#include "base/math.h"
#include "xr/simulator/handles.h"
#include "xr/simulator/input/actions.h"
#include "xr/simulator/placement.h"

namespace foveray::simulator {

class Session;

class Space : public Object {
  public:
    using Handle = XrSpace;
    static constexpr XrObjectType object_type = XR_OBJECT_TYPE_SPACE;

    struct ActionSource {
        std::shared_ptr<Action> action;
        XrPath subaction_path;
    };
    using Origin = std::variant<XrReferenceSpaceType, ActionSource>;

    Space(std::shared_ptr<Session> session, Origin origin, const Pose& origin_from_space)
        : session_(std::move(session)), origin_(std::move(origin)), origin_from_space_(origin_from_space) {}

    const Session& session() const { return *session_; }
    Placement place(XrTime time) const;

  private:
    Placement place_origin(XrTime time) const;

    std::shared_ptr<Session> session_;
    Origin origin_;
    Pose origin_from_space_;
};

struct SpaceLocation {
    Pose base_from_space;
    XrSpaceLocationFlags flags = 0;
    XrTime sample_time = 0;
};

SpaceLocation locate(const Space& space, const Space& base, XrTime time);

/// Of the stage; base_from_space is base_from_stage.
SpaceLocation locate_stage(const Space& base, XrTime time);

struct Velocity {
    vec3 linear{0.0f}, angular{0.0f};  // in the base's axes, metres and radians a second
    bool valid = false;
};
XrSpaceVelocityFlags velocity_flags(const Velocity& velocity);

/// Some milliseconds before and after a time, between which velocities are measured.
struct TimeSpan {
    XrTime begin, end;
};
TimeSpan span_round(XrTime time);
Velocity velocity_between(const Pose& before, const Pose& after, TimeSpan span);
Velocity velocity(const Space& space, const Space& base, XrTime time);

/// base_from_head with the flags of an XrViewState.
struct HeadLocation {
    Pose base_from_head;
    XrViewStateFlags flags = 0;
};
HeadLocation locate_head(const Space& base, XrTime time);

}  // namespace foveray::simulator
