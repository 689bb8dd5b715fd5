// Refines the flow of every cell by Gauss-Newton steps. The error of the initial flow must be less
// than a pixel. The patch is deformed according to the change of the flow around the cell. If the
// two cameras see a surface from different directions, an undeformed patch would fit best at a
// wrong position.
// In: a field in cells[]. Out: another field in cells[]: flow (x, y) [px], cost, texture (sum of
// the squared deviations of the patch from its mean). Tiles that are not matched keep their flow
// vectors. One invocation per cell.
// Source: Baker and Matthews, Lucas-Kanade 20 years on, IJCV 2004, section 3.2.
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

layout(std430, binding = 2) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];  // for each tile (workgroup): x = 1 if it changed, y = 1 if it is matched
};

#include "patch_template.glsl"

#include "flow_cells.glsl"

// Reads two words (eight pixels) of row y and shifts them by `shift` bits. So the result begins
// `shift` / 8 pixels later and ends with zeros. `wx` is the number of the first word, counted from
// the beginning of the row's margin.
uvec2 fetchShort(LumaLevel l, int wx, int y, uint shift) {
    int at = l.offset + clamp(y, 0, l.height - 1) * l.pitch + wx;
    uvec2 w = uvec2(luma[at], luma[at + 1]);
    if (shift == 0u) return w;
    return uvec2((w.x >> shift) | (w.y << (32u - shift)), w.y >> shift);
}

// Returns four pixels of the deformed patch, beginning at `first`. The flow changes by dx and dy
// per pixel. The deformation moves each of the four pixels by less than half a pixel, so the same
// words of the pyramid (see luma.glsl) suffice for all four.
vec4 bentRow(LumaLevel l, ivec2 cell, vec2 u, vec2 dx, vec2 dy, vec2 first) {
    const vec4 along = vec4(-1.5, -0.5, 0.5, 1.5);
    vec2 origin = vec2(patchStart(cell, sizeOf(l))) + first;
    vec2 middle = origin - vec2(4 * cell) - vec2(0.0, 1.5);
    origin += u + middle.x * dx + middle.y * dy;
    origin = clamp(origin, vec2(-7.0), vec2(l.width + 2, l.height + 2));
    vec2 whole = floor(origin);
    ivec2 at = ivec2(whole);
    int wx = (at.x >> 2) + kLumaMarginWords;
    uint shift = uint(at.x & 3) * 8u;
    uvec2 w0 = fetchShort(l, wx, at.y, shift), w1 = fetchShort(l, wx, at.y + 1, shift);
    vec4 fx = origin.x - whole.x + dx.x * along, fy = origin.y - whole.y + dx.y * along;
    vec4 q0 = unpackPixels(w0.x), q1 = unpackPixels(w1.x);
    vec4 upper = q0 + (vec4(q0.yzw, float(w0.y & 255u)) - q0) * fx;
    vec4 lower = q1 + (vec4(q1.yzw, float(w1.y & 255u)) - q1) * fx;
    return upper + (lower - upper) * fy;
}

// Adds four pixels b of the searched picture to the sums: the left half (side 0) or the right half
// (side 1) of row r of the patch.
void addHalf(inout Sums sums, int r, int side, vec4 b) {
    int at = 3 * r + 3;
    vec4 a = unpackPixels(templateWords[at + side]);
    uint other = templateWords[at + 1 - side], sides = templateWords[at + 2];
    float before = float(side == 0 ? (sides >> 8) & 255u : other >> 24);
    float after = float(side == 0 ? other & 255u : (sides >> 16) & 255u);
    vec4 gx = vec4(a.yzw, after) - vec4(before, a.xyz);
    vec4 gy = unpackPixels(templateWords[at + 3 + side]) - unpackPixels(templateWords[at - 3 + side]);
    sums.b += dot(b, vec4(1.0));
    sums.bb += dot(b, b);
    sums.ab += dot(a, b);
    sums.gb += vec2(dot(gx, b), dot(gy, b));
}

// Compares the template with the searched picture. The flow changes by dx and dy per pixel.
Match compareBent(LumaLevel l, ivec2 cell, vec2 u, vec2 dx, vec2 dy) {
    Sums sums = Sums(0.0, 0.0, 0.0, vec2(0.0));
    // Each iteration processes half a row, because a whole row with its gradients needs more
    // registers than a V3D has.
    int end = cell.y + 2 * kRows;
    for (int i = cell.y; i < end; ++i) {
        int side = (i - cell.y) & 1, r = (i - cell.y) >> 1;
        addHalf(sums, r, side, bentRow(l, cell, u, dx, dy, vec2(4 * side, r)));
    }
    return matchOf(sums);
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    if (tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x].y == 0u) {
        cells[params.target + cell.y * params.columns + cell.x] = vec4(flowAt(cell), 0.0, 0.0);
        return;
    }
    LumaLevel lb = params.to;
    vec2 known = loadTemplate(params.from, cell);
    vec2 dx = slopeAt(cell, ivec2(1, 0)), dy = slopeAt(cell, ivec2(0, 1));
    prepareSteps(known, cell);
    vec2 u = flowAt(cell), best = u;
    float cost = 1e9;
    // After an iteration that does not lower the cost, or whose step is too short, the remaining
    // iterations compare the best position again. On vector processors, this is cheaper than
    // leaving the loop.
    for (int k = 0; k <= params.steps; ++k) {
        Match m = compareBent(lb, cell, u, dx, dy);
        bool better = m.cost < cost;
        cost = better ? m.cost : cost;
        best = better ? u : best;
        u = better && dot(m.step, m.step) > kShortestStep ? u + m.step : best;
    }
    cells[params.target + cell.y * params.columns + cell.x] = vec4(best, cost, momentAt(1));
}
