// Turns what was measured of the tiles into work: says which of them changed and opens or shuts every
// registered dispatch of the frame.
// Changes that are too weak for one tile, as of a smooth slope that moves, show in the sum over many: where
// the difference's 2x2 means vary by more than the noise of its pixels explains, over all tiles that did
// not surely change or over a block of 8x8, those are drawn anew. So what tiles left alone are off by stays
// a small share of the noise's variance.
// Tiles with structure beyond noise, and those beside them, are matched with the still; where there are too
// many, those with the most.
// Tiles that something was drawn over count as changed, all of them, once one of them or beside them has,
// the whole frame is drawn, or they are told to. In: measured[] of plan_change.comp.
// Out: header = whole frame drawn at once (0: no, 1: yes, 2: enlarged, with a list of tiles with detail),
// changed tiles; tiles[] = changed, matched (1 or 0); dispatches[] = group counts, 0 when nothing changed or
// none of what did is matched; summary = changed tiles, quietest decile of the noise
// [1/256 grey level], whole, what was drawn over is drawn anew (1 or 0); wholeDraw = command of the
// full-screen draws, detail = of those that add detail, enlarged = of those that do not; grain = of the tiles
// that did not surely change: a 2x2 mean's noise variance in quarters of a pixel's [1/1024], their number,
// changed tiles that are matched.
// Range: tiles 0..1, 0..1

layout(local_size_x = 1) in;
layout(std140, binding = 0) uniform Params {
    ivec4 counts;    // tiles, dispatches, changed tiles from which on the whole frame is drawn, tiles a row
    ivec4 drawnOver; // columns and rows of tiles: x0 <= x < x1, y0 <= y < y1
    ivec4 redraw;    // x = 1: they count with any other, 2: whatever happens; y = 1: every tile counts as changed
    vec4 noise;      // a 2x2 mean's variance in quarters of a pixel's; structure that is none (below 0: all is), -, -
    ivec4 matched;   // at most so many tiles; at most so many for a list instead of the whole frame, -, -
};
layout(std430, binding = 0) buffer Tiles {
    uvec2 header;
    uvec2 tiles[];
};
layout(std430, binding = 1) readonly buffer Wanted {
    uvec4 wanted[];  // group counts of each dispatch, 1 when it is for matched tiles alone
};
layout(std430, binding = 2) buffer Plan {
    uvec4 summary;
    uvec4 wholeDraw;  // vertices, instances, first vertex, reserved
    uvec4 grain;
    uvec4 detail;
    uvec4 enlarged;
    uvec4 dispatches[];
};
layout(std430, binding = 3) buffer Measured {
    vec4 measured[];
};

const int kBins = 64;  // of 1/16 grey level
const int kBlock = 8;  // tiles
// Standard deviation of a tile's sum of squares over its mean, and how many of them are no accident.
const float kSpread = 0.27;
const float kSignificant = 5.0;
// Share of the noise that a change may always hide in: what 8-bit steps are off from white noise.
const float kLeast = 0.03;

/// Of tiles that did not surely change: number, mean squares of pixels, of 2x2 means and of their twist.
vec4 sumOver(ivec2 first, ivec2 end) {
    vec4 sum = vec4(0.0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            int at = 2 * (y * counts.w + x);
            if (measured[at].x == 0.0) sum += vec4(1.0, measured[at + 1].xyz);
        }
    }
    return sum;
}

bool drifted(vec4 sum) {
    float room = max(kSignificant * kSpread * inversesqrt(max(sum.x, 1.0)), kLeast);
    return sum.z > (1.0 + room) * noise.x * sum.y + 0.01 * sum.x;
}

void markAll(ivec2 first, ivec2 end) {
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) measured[2 * (y * counts.w + x)].x = 1.0;
}

#include "plan_structure.glsl"

void main() {
    int rows = counts.x / counts.w;
    ivec2 end = ivec2(counts.w, rows);
    vec4 all = sumOver(ivec2(0), end);
    if (redraw.y != 0 || drifted(all)) markAll(ivec2(0), end);
    for (int y = 0; y < rows; y += kBlock) {
        for (int x = 0; x < counts.w; x += kBlock) {
            ivec2 first = ivec2(x, y), last = min(first + kBlock, end);
            if (drifted(sumOver(first, last))) markAll(first, last);
        }
    }
    int least = leastStructure();
    uint changed = 0u, listed = 0u;
    uint histogram[kBins];
    for (int i = 0; i < kBins; ++i) histogram[i] = 0u;
    for (int i = 0; i < counts.x; ++i) {
        vec2 t = measured[2 * i].xy;
        changed += uint(t.x);
        float around = measured[2 * i].w;
        bool isMatched = around > noise.y && structureBin(around) >= least;
        tiles[i] = uvec2(uint(t.x), isMatched ? 1u : 0u);
        histogram[clamp(int(t.y * 16.0), 0, kBins - 1)]++;
    }
    bool under = redraw.x == 2 || (redraw.x == 1 && changed > 0u) || changed >= uint(counts.z);
    for (int y = max(drawnOver.y - 1, 0); y < min(drawnOver.w + 1, rows); ++y)
        for (int x = max(drawnOver.x - 1, 0); x < min(drawnOver.z + 1, counts.w); ++x)
            under = under || measured[2 * (y * counts.w + x)].x != 0.0;
    if (under) {
        for (int y = drawnOver.y; y < drawnOver.w; ++y) {
            for (int x = drawnOver.x; x < drawnOver.z; ++x) {
                int i = y * counts.w + x;
                changed += 1u - uint(measured[2 * i].x);
                tiles[i].x = 1u;
            }
        }
    }
    uint below = 0u;
    int bin = 0;
    for (; bin < kBins - 1; ++bin) {
        below += histogram[bin];
        if (below * 10u >= uint(counts.x)) break;
    }
    for (int i = 0; i < counts.x; ++i) listed += tiles[i].x * tiles[i].y;
    uint whole = changed >= uint(counts.z) ? 1u : 0u;
    bool listsDetail = whole != 0u && int(listed) <= matched.y;
    detail = uvec4(3u, listsDetail ? 0u : whole, 0u, 0u);
    enlarged = uvec4(3u, listsDetail ? whole : 0u, 0u, 0u);
    summary = uvec4(changed, uint(bin) * 16u + 8u, whole, under ? 1u : 0u);
    wholeDraw = uvec4(3u, whole, 0u, 0u);
    float ratio = all.w / max(all.y, 1e-3);
    grain = uvec4(uint(clamp(ratio, 0.0, 64.0) * 1024.0), uint(all.x), listed, 0u);
    header = uvec2(listsDetail ? 2u : whole, changed);
    for (int i = 0; i < counts.y; ++i)
        dispatches[i] = (wanted[i].w != 0u ? listed : changed) > 0u ? uvec4(wanted[i].xyz, 0u) : uvec4(0u, 1u, 1u, 0u);
}
