// Where a probe stands and whether it sleeps, from what all of its rays saw: Majercik et al. 2021, sections 5 and 6.
// Part of probe_update.comp, whose `push`, `ray_direction` and `ray_seen` it uses.
#ifndef FOVERAY_RENDER_PROBE_MOTION_GLSL
#define FOVERAY_RENDER_PROBE_MOTION_GLSL

const float INSIDE_PART = 0.25;  // of the rays that see inner sides: the probe is within something
const float ELBOW_ROOM = 0.2;    // of the spacing: nearer surfaces push a probe away
const float REACH = 0.45;        // of the spacing: as far as a probe may be from its place
const uint QUIET_ENOUGH = 8;     // updates without anything near: the probe falls asleep
const uint NO_RAY = 0xFFFFFFFFu;

shared uint inner_sides, near_hits, nearest_inner, nearest_outer;  // the last two: distance with the ray in the low bits

void start_survey(uint thread) {
    if (thread == 0) {
        inner_sides = near_hits = 0;
        nearest_inner = nearest_outer = NO_RAY;
    }
    barrier();
}

void survey(ProbeField field, ProbeState state, uint ray, vec3 direction, float seen) {
    uint key = (floatBitsToUint(abs(seen)) & ~(PROBE_MAX_RAYS - 1)) | ray;
    if (seen < 0.0) {
        atomicAdd(inner_sides, 1);
        atomicMin(nearest_inner, key);
    } else {
        atomicMin(nearest_outer, key);
        // Lit by this probe is what is less than a cell away along every axis.
        vec3 cells = abs(state.offset + seen * direction) / field.spacing;
        if (max(cells.x, max(cells.y, cells.z)) < 1.0) atomicAdd(near_hits, 1);
    }
}

bool survey_says_inside() { return float(inner_sides) > INSIDE_PART * float(push.ray_count); }

bool within_reach(ProbeField field, vec3 offset) {
    vec3 cells = abs(offset) / field.spacing;
    return max(cells.x, max(cells.y, cells.z)) <= REACH;
}

// Out of what it is within; the same place if that is too far.
vec3 way_out(ProbeField field, vec3 offset, float room) {
    uint ray = nearest_inner & (PROBE_MAX_RAYS - 1);
    vec3 out_there = offset + (-ray_seen[ray].w + 0.5 * room) * ray_direction[ray];
    return within_reach(field, out_there) ? out_there : offset;
}

// Away from what is too near, back home when there is room. What lies between keeps probes from wandering.
vec3 better_place(ProbeField field, vec3 offset, float room) {
    uint ray = nearest_outer & (PROBE_MAX_RAYS - 1);
    float nearest = ray_seen[ray].w;
    if (nearest < room) {
        vec3 away = offset - 0.5 * (room - nearest) * ray_direction[ray];
        return within_reach(field, away) ? away : offset;
    }
    float from_home = length(offset);
    if (from_home == 0.0 || nearest < 2.0 * room) return offset;
    return offset * (1.0 - min(0.5 * (nearest - 2.0 * room) / from_home, 1.0));
}

ProbeState next_state(ProbeField field, ProbeState state, bool inside) {
    float room = ELBOW_ROOM * min(field.spacing.x, min(field.spacing.y, field.spacing.z));
    bool may_move = (push.flags & PROBES_RELOCATE) != 0;
    if (inside) {
        vec3 offset = may_move ? way_out(field, state.offset, room) : state.offset;
        // Elsewhere it starts anew.
        return offset == state.offset ? ProbeState(offset, PROBE_STARTED | PROBE_INSIDE, 0.0, 0.0)
                                      : ProbeState(offset, 0, 0.0, 0.0);
    }
    bool was_inside = (state.flags & PROBE_INSIDE) != 0;
    uint quiet = near_hits > 0 ? 0 : min(state.flags / PROBE_QUIET_STEP + 1, 255);
    bool asleep = (push.flags & PROBES_SLEEP) != 0 && quiet >= QUIET_ENOUGH;
    state.flags = quiet * PROBE_QUIET_STEP | (asleep ? PROBE_ASLEEP : 0) | (was_inside ? 0 : PROBE_STARTED);
    if (may_move && nearest_outer != NO_RAY) state.offset = better_place(field, state.offset, room);
    return state;
}

#endif
