// Tiles are 16x16 video pixels = 4x4 cells; the classes are those of pipeline/plan/tiles.h.
const uint kUnchanged = 0u;
const uint kUpscaled = 1u;
const uint kTrusted = 2u;
const uint kBlended = 3u;

uint packTile(ivec2 tile) {
    return uint(tile.x) | (uint(tile.y) << 16);
}
ivec2 unpackTile(uint packedTile) {
    return ivec2(packedTile & 0xffffu, packedTile >> 16);
}
