#include "pipeline/engine/params/detail.h"

uint packTile(ivec2 tile) {
    return uint(tile.x) | (uint(tile.y) << 16);
}
ivec2 unpackTile(uint packedTile) {
    return ivec2(packedTile & 0xffffu, packedTile >> 16);
}
