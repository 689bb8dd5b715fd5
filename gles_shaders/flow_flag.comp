// Which tiles of 16x16 pixels the epipolar lines do not explain: cells with texture that match badly
// although the still shows the place. There something moved or came into view, or the pose is wrong.
// In: refined forward field and its two-way errors in patches[]. Out: flags[] = 1 or 0. One invocation a
// tile.
// Range: flags 0..1

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    ivec4 tiles;    // tiles a row, rows, cells a row, rows
    ivec4 offsets;  // in patches[]: field, two-way errors; least cells of a flagged tile, -
    vec4 tune;      // least texture [grey levels^2], least cost, most two-way error [px], -
};
layout(std430, binding = 1) readonly buffer Patches {
    vec4 patches[];
};
layout(std430, binding = 2) writeonly buffer Flags {
    uint flags[];
};

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, tiles.xy))) return;
    int unexplained = 0;
    for (int i = 0; i < 16; ++i) {
        ivec2 c = 4 * tile + ivec2(i & 3, i >> 2);
        if (any(greaterThanEqual(c, tiles.zw))) continue;
        int at = c.y * tiles.z + c.x;
        vec2 match = patches[offsets.x + at].zw;
        bool shown = patches[offsets.y + at].x < tune.z;
        if (shown && match.x > tune.y && match.y > tune.x) ++unexplained;
    }
    flags[tile.y * tiles.x + tile.x] = unexplained >= offsets.z ? 1u : 0u;
}
