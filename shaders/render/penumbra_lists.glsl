// Appends to a list of penumbras. Their order depends on chance, what becomes of each does not.
#ifndef FOVERAY_RENDER_PENUMBRA_LISTS_GLSL
#define FOVERAY_RENDER_PENUMBRA_LISTS_GLSL

#include "shaders/render/penumbra.glsl"

void append(uint64_t list, bool wanted, uint entry) {
    PenumbraEntries entries = PenumbraEntries(list);
    uvec4 ballot = subgroupBallot(wanted);
    uint first = 0;
    if (subgroupElect()) first = atomicAdd(entries.list.width, subgroupBallotBitCount(ballot));
    first = subgroupBroadcastFirst(first);
    if (wanted) entries.at[first + subgroupBallotExclusiveBitCount(ballot)] = entry;
}

#endif
