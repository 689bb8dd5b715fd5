// Finds the class of every tile and makes the frame's draw lists. One invocation per tile.
// In: change flags; cell fields of one or two stills.
// Out: lists[] = five lists of tiles: 0 every drawn tile, 1 tiles that are only enlarged, 2 trusted
// tiles, 3 blended tiles, 4 tiles that show some of the second still. A tile is drawn if it changed
// or if the whole frame is drawn (header.x is not 0, see below). Lists 0 and 1 are filled only if
// header.x is 0, lists 2 and 3 only if it is 0 or 2. List 0 also contains unchanged neighbours of
// tiles that show detail or are enlarged by learned filters, because such tiles read their
// neighbours.
// draws[] = indirect draw commands, one per list; before this shader runs, only the number of
// vertices in each is set. counts[] = counters of the frame, initially 0. classes[] = class of each
// tile.
// Range: classes 0..3, 0..16
#include "tiles.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    ClassifyTiles params;
};
layout(std430, binding = 0) readonly buffer Changed {
    // x: how the frame is drawn (0: only the listed tiles; 1: the whole frame at once; 2: the whole
    // frame is enlarged at once, and detail is added in the listed tiles). y: number of changed
    // tiles.
    uvec2 header;
    uvec2 changed[];
};
layout(std430, binding = 1) buffer Classes {
    // x: class in this frame; y: number of cells without a reliable match when the tile was last
    // drawn.
    uvec2 classes[];
};
layout(std430, binding = 2) buffer Draws {
    uvec4 draws[5];    // vertices, instances, first vertex, reserved
    // [0] to [3]: number of tiles of each class. [4]: unused. [5]: number of tiles with many cells
    // that match neither still. [6]: 256 * the sum of the tiles' mean confidences. [7]: number of
    // tiles that show the second still.
    uint counts[8];
};
layout(std430, binding = 3) buffer Lists {
    // The five lists of tiles (see Out). After them, one entry per tile: the number of the frame in
    // which the tile was last listed as a neighbour.
    uint lists[];
};
layout(binding = 0) uniform sampler2D cellField;
layout(binding = 1) uniform sampler2D weightField;
layout(binding = 2) uniform sampler2D secondCells;
layout(binding = 3) uniform sampler2D secondWeights;

ivec2 lastCell() {
    return ivec2(params.cellColumns, params.cellRows) - 1;
}

vec4 cellAt(ivec2 c) {
    return texelFetch(cellField, clamp(c, ivec2(0), lastCell()), 0);
}

// Finds the class of a drawn tile, whose first cell is `first`. A tile is trusted (plain) if it
// can be drawn as one rectangle: its flow is affine and its weight is uniform (within tolerances).
uint classOf(ivec2 first) {
    vec4 low = vec4(1e9), high = vec4(-1e9);
    for (int i = 0; i < 36; ++i) {
        vec4 c = cellAt(first + ivec2(i % 6 - 1, i / 6 - 1));
        low = min(low, c);
        high = max(high, c);
    }
    if (!(high.z > params.leastWeight)) return kTileEnlarged;
    if (!(high.z - low.z < kPlainWeight)) return kTileBlended;
    vec2 origin = cellAt(first).xy;
    vec2 dx = (cellAt(first + ivec2(3, 0)).xy - origin) / 3.0;
    vec2 dy = (cellAt(first + ivec2(0, 3)).xy - origin) / 3.0;
    for (int i = 0; i < 36; ++i) {
        ivec2 k = ivec2(i % 6 - 1, i / 6 - 1);
        vec2 d = abs(cellAt(first + k).xy - origin - float(k.x) * dx - float(k.y) * dy);
        if (!(max(d.x, d.y) < params.plainFlow)) return kTileBlended;
    }
    return kTileTrusted;
}

bool secondIsMore(ivec2 c) {
    return texelFetch(secondCells, c, 0).z > texelFetch(cellField, c, 0).z + kSecondFrom;
}

// True if a tile shows some of the second still. The cells around the tile are tested too, because
// the weights of the tile's outer pixels are interpolated with them.
bool showsSecond(ivec2 first) {
    ivec2 low = max(first - 1, ivec2(0)), high = min(first + 4, lastCell());
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
            if (secondIsMore(ivec2(x, y))) return true;
    return false;
}

bool isUnexplained(ivec2 c) {
    if (texelFetch(weightField, c, 0).w < 0.5) return false;
    return params.secondGiven == 0 || texelFetch(secondWeights, c, 0).w >= 0.5 || !secondIsMore(c);
}

void append(uint list, uint packedTile) {
    uint at = atomicAdd(draws[list].y, 1u);
    lists[int(list) * params.columns * params.rows + int(at)] = packedTile;
}

// Appends the tile's unchanged neighbours to list 0, each of them only once per frame.
void appendUnchangedAround(ivec2 tile) {
    ivec2 first = max(tile - 1, ivec2(0)), last = min(tile + 1, ivec2(params.columns, params.rows) - 1);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            int index = y * params.columns + x;
            if (changed[index].x != 0u) continue;
            uint before = atomicExchange(lists[5 * params.columns * params.rows + index], params.detailFrame);
            if (before != params.detailFrame) append(0u, packTile(ivec2(x, y)));
        }
    }
}

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, ivec2(params.columns, params.rows)))) return;
    int index = tile.y * params.columns + tile.x;
    uint kind = kTileUnchanged;
    uint unexplained = classes[index].y;
    float confidence = 0.0;
    for (int i = 0; i < 16; ++i)
        confidence += cellAt(4 * tile + ivec2(i & 3, i >> 2)).w;
    bool stillGiven = params.stillGiven != 0;
    bool whole = header.x != 0u;
    if (whole || changed[index].x != 0u) {
        kind = !stillGiven || changed[index].y == 0u ? kTileEnlarged : classOf(4 * tile);
        unexplained = !stillGiven ? 16u : 0u;
        if (stillGiven) {
            for (int i = 0; i < 16; ++i)
                unexplained += uint(isUnexplained(min(4 * tile + ivec2(i & 3, i >> 2), lastCell())));
        }
        if (params.secondGiven != 0 && showsSecond(4 * tile)) {
            kind = kTileBlended;
            append(4u, packTile(tile));
            atomicAdd(counts[7], 1u);
        }
        if (!whole) append(0u, packTile(tile));
        if (!whole || (header.x == 2u && kind != kTileEnlarged)) append(kind, packTile(tile));
        bool learns = params.learns != 0 && changed[index].y != 0u;
        if (!whole && (learns || kind != kTileEnlarged) && params.detailFrame != 0u) appendUnchangedAround(tile);
    }
    classes[index] = uvec2(kind, unexplained);
    atomicAdd(counts[kind], 1u);
    if (unexplained >= kUnexplainedCells) atomicAdd(counts[5], 1u);
    if (stillGiven) atomicAdd(counts[6], uint(confidence * 16.0));
}
