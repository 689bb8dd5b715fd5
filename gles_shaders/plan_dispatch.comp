// Turns the change flags into work: counts the changed tiles and opens or shuts every registered
// dispatch of the frame. Tiles that something was drawn over count as changed, all of them, once one
// of them or beside them has, the whole frame is drawn, or they are told to. In: tiles[].
// Out: header = whole frame drawn at once (1 or 0), changed tiles; dispatches[] = group counts, 0 when
// nothing changed; summary = changed tiles, quietest decile of the noise [1/256 grey level], whole,
// what was drawn over is drawn anew (1 or 0); wholeDraw = command of the full-screen draws.

layout(local_size_x = 1) in;
layout(std140, binding = 0) uniform Params {
    ivec4 counts;    // tiles, dispatches, changed tiles from which on the whole frame is drawn, tiles a row
    ivec4 drawnOver; // columns and rows of tiles: x0 <= x < x1, y0 <= y < y1
    ivec4 redraw;    // x = 1: they count with any other, 2: whatever happens
};
layout(std430, binding = 0) buffer Tiles {
    uvec2 header;
    uvec2 tiles[];
};
layout(std430, binding = 1) readonly buffer Wanted {
    uvec4 wanted[];  // group counts of each dispatch
};
layout(std430, binding = 2) buffer Plan {
    uvec4 summary;
    uvec4 wholeDraw;  // vertices, instances, first vertex, reserved
    uvec4 dispatches[];
};

const int kBins = 64;  // of 1/16 grey level

void main() {
    uint changed = 0u;
    uint histogram[kBins];
    for (int i = 0; i < kBins; ++i) histogram[i] = 0u;
    for (int i = 0; i < counts.x; ++i) {
        uvec2 t = tiles[i];
        changed += t.x;
        histogram[min(t.y / 16u, uint(kBins - 1))]++;
    }
    bool under = redraw.x == 2 || (redraw.x == 1 && changed > 0u) || changed >= uint(counts.z);
    for (int y = max(drawnOver.y - 1, 0); y < min(drawnOver.w + 1, counts.x / counts.w); ++y)
        for (int x = max(drawnOver.x - 1, 0); x < min(drawnOver.z + 1, counts.w); ++x)
            under = under || tiles[y * counts.w + x].x != 0u;
    if (under) {
        for (int y = drawnOver.y; y < drawnOver.w; ++y) {
            for (int x = drawnOver.x; x < drawnOver.z; ++x) {
                int i = y * counts.w + x;
                changed += 1u - tiles[i].x;
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
    uint whole = changed >= uint(counts.z) ? 1u : 0u;
    summary = uvec4(changed, uint(bin) * 16u + 8u, whole, under ? 1u : 0u);
    wholeDraw = uvec4(3u, whole, 0u, 0u);
    header = uvec2(whole, changed);
    for (int i = 0; i < counts.y; ++i)
        dispatches[i] = changed > 0u ? wanted[i] : uvec4(0u, 1u, 1u, 0u);
}
