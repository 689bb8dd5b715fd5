// Packs the position of a tile into one word. A tile has 16x16 video pixels, that is, 4x4 cells.
#include "pipeline/engine/params/detail.h"

uint packTile(ivec2 tile) {
    return uint(tile.x) | (uint(tile.y) << 16);
}
ivec2 unpackTile(uint packedTile) {
    return ivec2(packedTile & 0xffffu, packedTile >> 16);
}
