// Turns what was measured of the tiles into work: says which of them changed and opens or shuts every
// registered dispatch of the frame.
// Changes that are too weak for one tile, as of a smooth slope that moves, show in the sum over many: where
// the difference's 2x2 means vary by more than the noise of its pixels explains, over all tiles that did
// not surely change or over a block of 8x8, those are drawn anew. So what tiles left alone are off by stays
// a small share of the noise's variance.
// Tiles with structure beyond noise, and those beside them, are matched with the still; where there are too
// many, those with the most, and rather those that were.
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

layout(local_size_x = 64) in;
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
layout(std430, binding = 2) writeonly buffer Plan {
    uvec4 summary;
    uvec4 wholeDraw;  // vertices, instances, first vertex, reserved
    uvec4 grain;
    uvec4 detail;
    uvec4 enlarged;
    uvec4 dispatches[];
};
layout(std430, binding = 3) coherent buffer Measured {
    vec4 measured[];
};

const int kWorkers = 64;
const int kBins = 64;  // of 1/16 grey level

shared uint noiseBins[kBins];
shared uint measuredChanges, drawnChanges, listed;  // tiles
shared uint besideChange;  // 1: a tile that was drawn over, or one beside them, changed

// What all of them have written is seen by all.
void meet() {
    memoryBarrierBuffer();
    memoryBarrierShared();
    barrier();
}

#include "plan_drift.glsl"
#include "plan_structure.glsl"

void clearShared(int worker) {
    for (int i = worker; i < kBins; i += kWorkers) noiseBins[i] = 0u;
    for (int i = worker; i < kStructureBins; i += kWorkers) structureBins[i] = 0u;
    if (worker == 0) {
        measuredChanges = 0u;
        drawnChanges = 0u;
        listed = 0u;
        besideChange = 0u;
    }
}

bool isDrawnOver(int tile, int margin) {
    ivec2 at = ivec2(tile % counts.w, tile / counts.w);
    return all(greaterThanEqual(at, drawnOver.xy - margin)) && all(lessThan(at, drawnOver.zw + margin));
}

void countChanges(int worker) {
    uint changed = 0u;
    for (int i = worker; i < counts.x; i += kWorkers) {
        vec2 t = measured[2 * i].xy;
        changed += uint(t.x);
        if (t.x != 0.0 && isDrawnOver(i, 1)) atomicMax(besideChange, 1u);
        atomicAdd(noiseBins[clamp(int(t.y * 16.0), 0, kBins - 1)], 1u);
    }
    atomicAdd(measuredChanges, changed);
}

void writeTiles(int worker, bool under, int least) {
    for (int i = worker; i < counts.x; i += kWorkers) {
        float around = measured[2 * i].w;
        bool isMatched = around > noise.y && structureBin(around) >= least;
        bool changes = measured[2 * i].x != 0.0 || (under && isDrawnOver(i, 0));
        tiles[i] = uvec2(changes ? 1u : 0u, isMatched ? 1u : 0u);
        if (changes) atomicAdd(drawnChanges, 1u);
        if (changes && isMatched) atomicAdd(listed, 1u);
    }
}

int quietestDecile() {
    uint below = 0u;
    int bin = 0;
    for (; bin < kBins - 1; ++bin) {
        below += noiseBins[bin];
        if (below * 10u >= uint(counts.x)) break;
    }
    return bin;
}

void writePlan(vec4 total, bool under) {
    uint whole = drawnChanges >= uint(counts.z) ? 1u : 0u;
    bool listsDetail = whole != 0u && int(listed) <= matched.y;
    detail = uvec4(3u, listsDetail ? 0u : whole, 0u, 0u);
    enlarged = uvec4(3u, listsDetail ? whole : 0u, 0u, 0u);
    summary = uvec4(drawnChanges, uint(quietestDecile()) * 16u + 8u, whole, under ? 1u : 0u);
    wholeDraw = uvec4(3u, whole, 0u, 0u);
    float ratio = total.w / max(total.y, 1e-3);
    grain = uvec4(uint(clamp(ratio, 0.0, 64.0) * 1024.0), uint(total.x), listed, 0u);
    header = uvec2(listsDetail ? 2u : whole, drawnChanges);
}

void main() {
    int worker = int(gl_LocalInvocationIndex);
    clearShared(worker);
    vec4 total = energyOfAll(worker);
    markDrifted(worker, ivec2(counts.w, counts.x / counts.w), redraw.y != 0 || drifted(total));
    countStructure(worker);
    meet();
    int least = leastStructure();
    countChanges(worker);
    meet();
    bool under = redraw.x == 2 || (redraw.x == 1 && measuredChanges > 0u) ||
                 measuredChanges >= uint(counts.z) || besideChange != 0u;
    writeTiles(worker, under, least);
    meet();
    if (worker == 0) writePlan(total, under);
    for (int i = worker; i < counts.y; i += kWorkers) {
        bool opens = (wanted[i].w != 0u ? listed : drawnChanges) > 0u;
        dispatches[i] = opens ? uvec4(wanted[i].xyz, 0u) : uvec4(0u, 1u, 1u, 0u);
    }
}
