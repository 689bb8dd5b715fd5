// Evaluates the flow vectors of each cell's four neighbours. If the best of them costs less than
// the cell's own vector, the cell gets this vector, refined.
// In, out: two fields in cells[], in the format of flow_search.comp. One invocation per cell.
// Range: cells -2e4..2e4, -2e4..2e4, 0..2.02, 0..4.2e6
#include "luma.glsl"
#include "pipeline/engine/params/flow.h"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    RefineFlow params;
};
layout(std430, binding = 0) readonly buffer Luma {
    uint luma[];
};
layout(std430, binding = 1) buffer Cells {
    vec4 cells[];
};

#include "patch_refine.glsl"

const int kNeighbours = 4;

vec4 cellIn(ivec2 c) {
    c = clamp(c, ivec2(0), ivec2(params.columns, params.rows) - 1);
    return cells[params.source + c.y * params.columns + c.x];
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    vec4 own = cellIn(cell);
    vec2 best = own.xy;
    float found = own.z;
    LumaLevel lb = params.to;
    vec2 known = loadTemplate(params.from, cell);
    bool moved = false;
    for (int k = 0; k < kNeighbours; ++k) {
        ivec2 n = k == 0   ? ivec2(-1, 0)
                  : k == 1 ? ivec2(1, 0)
                  : k == 2 ? ivec2(0, -1)
                           : ivec2(0, 1);
        vec2 u = cellIn(cell + n).xy;
        vec2 d = u - best;
        if (dot(d, d) < kSameCandidate) continue;
        float cost = costAt(known, lb, cell, u);
        if (cost < found) {
            found = cost;
            best = u;
            moved = true;
        }
    }
    // refine() is called even without steps, because a branch around the call would need one more
    // register than a V3D (the GPU of a Raspberry Pi) has.
    refine(known, lb, cell, moved ? params.steps : -1, best, found);
    cells[params.target + cell.y * params.columns + cell.x] = vec4(best, found, momentAt(1));
}
