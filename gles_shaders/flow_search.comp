// Flow of every cell at one pyramid level: the best of the coarser level's vectors around it and of the
// last frame's (coarsest level: of a square of whole-pixel displacements), then Gauss-Newton steps.
// Out: patches[] = flow (x, y) [px of this level], cost, texture (energy of the patch). One invocation a cell.
// Variant: #define LISTED
// works on the groups of 4x4 cells in lists[] only, and turns the two-way errors of cells that leave
// their epipolar line into what their match is worth.
// After: Kroeger et al., Fast optical flow using dense inverse search, ECCV 2016, section 2.
// Range: patches -2e4..2e4, -2e4..2e4, 0..2.02, 0..4.2e6
#include "luma.glsl"
#ifdef LISTED
#include "tiles.glsl"
#endif

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    ivec4 from;     // level the template is taken from: offset, pitch, width, height
    ivec4 to;       // level it is sought in
    ivec4 cells;    // cells of this level, cells of the coarser one
    ivec4 offsets;  // in patches[]: output, coarser level (-1 = coarsest), last frame (-1 = none), -
    ivec4 search;   // radius at the coarsest level [px], candidates, steps, last frame's cells a row
    vec4 prior;     // this level's pixels per pixel of the last frame's field, its cells per cell
    ivec4 listed;   // first group in lists[], two-way errors in patches[] (-1 = not this level), -, -
};
layout(std430, binding = 0) readonly buffer Luma {
    uint luma[];
};
layout(std430, binding = 1) buffer Patches {
    vec4 patches[];
};

#ifdef LISTED
layout(std430, binding = 2) readonly buffer Lists {
    uint lists[];
};
// The z-test says nothing about what moves by itself: its cells are trusted by their cost, from wholly
// to not at all (error = alpha of eq. 2).
const float kGoodCost = 0.1;
const float kErrorPerCost = 5.0;
const float kOnLine = 1.0;  // [px]
// A cell leaves its line only for a cost this much lower: among many vectors one fits noise by chance.
const float kClearlyLess = 0.5;
#endif

#include "patch_template.glsl"

vec2 coarser(ivec2 c) {
    c = clamp(c, ivec2(0), cells.zw - 1);
    return 2.0 * patches[offsets.y + c.y * cells.z + c.x].xy;
}

vec2 lastFrame(ivec2 cell) {
    ivec2 c = ivec2((vec2(cell) + 0.5) * prior.yz);
    return prior.x * patches[offsets.z + c.y * search.w + c.x].xy;
}

vec2 candidate(ivec2 cell, int k) {
    if (k == 0 && offsets.z >= 0) return lastFrame(cell);
    if (offsets.z >= 0) --k;
    if (offsets.y < 0) {
        int n = 2 * search.x + 1;
        k = (k + n * n / 2) % (n * n);  // no motion first: it wins where nothing tells
        return vec2(k % n - search.x, k / n - search.x);
    }
    ivec2 c = cell >> 1;
    ivec2 towards = (cell & 1) * 2 - 1;
    return coarser(c + ivec2((k & 1) * towards.x, (k >> 1) * towards.y));
}

void main() {
#ifdef LISTED
    ivec2 group = unpackTile(lists[listed.x + int(gl_WorkGroupID.x)]);
    ivec2 cell = 4 * group + ivec2(gl_LocalInvocationID.xy);
#else
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
#endif
    if (any(greaterThanEqual(cell, cells.xy))) return;
    Level lb = levelOf(to);
    vec2 known = loadTemplate(levelOf(from), cell);
    vec2 best = vec2(1e9);
    float found = 1e9;
    for (int k = 0; k < search.y; ++k) {
        vec2 u = candidate(cell, k);
        vec2 d = u - best;
        if (dot(d, d) < 0.25) continue;
        float cost = costAt(known, lb, cell, u);
        if (cost < found) {
            found = cost;
            best = u;
        }
    }
    refine(known, lb, cell, search.z, best, found);
    int at = cell.y * cells.x + cell.x;
#ifdef LISTED
    vec4 line = patches[offsets.x + at];
    vec2 off = best - line.xy;
    if (listed.y >= 0 && dot(off, off) > kOnLine * kOnLine) {
        if (found > kClearlyLess * line.z) return;
        patches[listed.y + at].x = max(found - kGoodCost, 0.0) * kErrorPerCost;
    }
#endif
    patches[offsets.x + at] = vec4(best, found, known.y);
}
