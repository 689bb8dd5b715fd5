// Computes the flow of every cell at one pyramid level: refines the best candidate by Gauss-Newton
// steps. Candidates are the last frame's vector, if there is one, and the vectors of the next
// coarser pyramid level around the cell. At the coarsest pyramid level, all whole-pixel
// displacements within a square replace the vectors of the coarser level.
// Out: cells[] = flow (x, y) [px of this pyramid level], cost, texture (sum of the squared
// deviations of the patch from its mean). One invocation per cell.
// Source: Kroeger et al., Fast optical flow using dense inverse search, ECCV 2016, section 2.
// LISTED: processes only the groups of 4x4 cells in lists[]. The flow along epipolar lines takes
// the place of the last frame's vector. At the finest pyramid level, a vector that is more than
// kOnLine away from the flow along the epipolar line is used only if it fits clearly better
// (kClearlyLess). The cell's two-way error is then derived from the cost of the match.
// Variant: #define LISTED
// Range: cells -2e4..2e4, -2e4..2e4, 0..2.02, 0..4.2e6
#include "luma.glsl"
#include "pipeline/engine/params/flow.h"
#ifdef LISTED
#include "tiles.glsl"
#endif

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    SearchFlow params;
};
layout(std430, binding = 0) readonly buffer Luma {
    uint luma[];
};
layout(std430, binding = 1) buffer Cells {
    vec4 cells[];
};

#ifdef LISTED
layout(std430, binding = 2) readonly buffer Lists {
    uint lists[];
};
#endif

#include "patch_refine.glsl"

vec2 coarser(ivec2 c) {
    c = clamp(c, ivec2(0), ivec2(params.coarserColumns, params.coarserRows) - 1);
    return 2.0 * cells[params.coarser + c.y * params.coarserColumns + c.x].xy;
}

vec2 lastFrame(ivec2 cell) {
    ivec2 c = ivec2((vec2(cell) + 0.5) * vec2(params.lastFrameX, params.lastFrameY));
    return params.perLastFrame * cells[params.lastFrame + c.y * params.lastFrameColumns + c.x].xy;
}

vec2 candidate(ivec2 cell, int k) {
    if (k == 0 && params.lastFrame >= 0) return lastFrame(cell);
    if (params.lastFrame >= 0) --k;
    if (params.coarser < 0) {
        int n = 2 * params.radius + 1;
        // Displacement zero comes first, because the first of two vectors with equal costs wins.
        k = (k + n * n / 2) % (n * n);
        return vec2(k % n - params.radius, k / n - params.radius);
    }
    ivec2 c = cell >> 1;
    ivec2 towards = (cell & 1) * 2 - 1;
    return coarser(c + ivec2((k & 1) * towards.x, (k >> 1) * towards.y));
}

void main() {
#ifdef LISTED
    ivec2 group = unpackTile(lists[params.firstGroup + int(gl_WorkGroupID.x)]);
    ivec2 cell = 4 * group + ivec2(gl_LocalInvocationID.xy);
#else
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
#endif
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    LumaLevel lb = params.to;
    vec2 known = loadTemplate(params.from, cell);
    vec2 best = vec2(1e9);
    float found = 1e9;
    for (int k = 0; k < params.candidates; ++k) {
        vec2 u = candidate(cell, k);
        vec2 d = u - best;
        if (dot(d, d) < kSameCandidate) continue;
        float cost = costAt(known, lb, cell, u);
        if (cost < found) {
            found = cost;
            best = u;
        }
    }
    refine(known, lb, cell, params.steps, best, found);
    int at = cell.y * params.columns + cell.x;
#ifdef LISTED
    vec4 line = cells[params.target + at];
    vec2 off = best - line.xy;
    if (params.errors >= 0 && dot(off, off) > kOnLine * kOnLine) {
        if (found > kClearlyLess * line.z) return;
        cells[params.errors + at].x = max(found - kGoodCost, 0.0) * kErrorPerCost;
    }
#endif
    cells[params.target + at] = vec4(best, found, momentAt(1));
}
