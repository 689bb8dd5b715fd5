// Flags tiles in which the flow along epipolar lines does not fit: textured cells match badly
// although the still shows them. Either something moved or came into view there, or the pose is
// wrong.
// In: the refined forward field (from video to still) and its two-way errors, both in cells[].
// Out: flags[] = 1 or 0. One invocation per tile.
// Range: flags 0..1
#include "pipeline/engine/params/flow.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    FlagTiles params;
};
layout(std430, binding = 1) readonly buffer Cells {
    vec4 cells[];
};
layout(std430, binding = 2) writeonly buffer Flags {
    uint flags[];
};

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, ivec2(params.tileColumns, params.tileRows)))) return;
    int unexplained = 0;
    for (int i = 0; i < 16; ++i) {
        ivec2 c = 4 * tile + ivec2(i & 3, i >> 2);
        if (any(greaterThanEqual(c, ivec2(params.columns, params.rows)))) continue;
        int at = c.y * params.columns + c.x;
        vec2 match = cells[params.field + at].zw;
        bool shown = cells[params.errors + at].x < kNotShown;
        if (shown && match.x > kUnexplainedCost && match.y > params.leastTexture) ++unexplained;
    }
    flags[tile.y * params.tileColumns + tile.x] = unexplained >= kLeastUnexplained ? 1u : 0u;
}
