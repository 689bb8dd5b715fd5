// Lists the groups of 4x4 cells in which the 2-D search must run, at one pyramid level. One
// invocation per group. A group is listed if a flagged tile is in it or within a margin around it.
// The margin is needed because the search at the next finer pyramid level starts from vectors
// around each cell. A tile with at least two flagged neighbours (beside, above and below it) counts
// as flagged too: it may be a part of a moving object without texture, which flow_flag.comp cannot
// flag.
// In: flags[] of flow_flag.comp. Out: lists[] = packed positions of the listed groups; commands[] =
// the dispatch command of the pyramid level, initially (0, 1, 1, 0).
#include "tiles.glsl"
#include "pipeline/engine/params/flow.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    ListTiles params;
};
layout(std430, binding = 0) readonly buffer Flags {
    uint flags[];
};
layout(std430, binding = 1) buffer Commands {
    uvec4 commands[];
};
layout(std430, binding = 2) writeonly buffer Lists {
    uint lists[];
};

uint flagAt(int x, int y) {
    bool within = x >= 0 && y >= 0 && x < params.tileColumns && y < params.tileRows;
    return within ? flags[y * params.tileColumns + x] : 0u;
}

bool flagged(int x, int y) {
    uint beside = flagAt(x - 1, y) + flagAt(x + 1, y) + flagAt(x, y - 1) + flagAt(x, y + 1);
    return flagAt(x, y) != 0u || beside >= 2u;
}

void main() {
    ivec2 group = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(group, ivec2(params.groupColumns, params.groupRows)))) return;
    ivec2 first = max(params.tilesPerGroup * group - params.margin, ivec2(0));
    ivec2 end = min(params.tilesPerGroup * (group + 1) + params.margin, ivec2(params.tileColumns, params.tileRows));
    bool needed = false;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) needed = needed || flagged(x, y);
    if (!needed) return;
    uint at = atomicAdd(commands[params.command].x, 1u);
    lists[params.first + int(at)] = packTile(group);
}
