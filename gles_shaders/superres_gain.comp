// Photometric gain between the sensors, measured at half resolution: there the blur in which they differ
// no longer counts. In: forward field, both pictures' second luma level. Out: covariance, variance of the
// video and of the still per half-resolution cell (8x8 video pixels); none in tiles that are not matched.
// Range: statistics -4.2e6..4.2e6, 0..4.2e6, 0..4.2e6, 0..0
#include "luma.glsl"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    ivec4 video;    // second level of the video: offset, pitch, width, height
    ivec4 still;    // second level of the still at the video's geometry
    ivec4 cells;    // half-resolution cells a row, rows, forward cells a row, rows
    ivec4 offsets;  // in patches[]: forward field; tiles a row, -, -
};
layout(std430, binding = 0) readonly buffer Luma {
    uint luma[];
};
layout(std430, binding = 1) readonly buffer Patches {
    vec4 patches[];
};
layout(std430, binding = 2) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];  // changed, matched
};
layout(rgba32f, binding = 0) uniform writeonly highp image2D statistics;

#include "patch.glsl"

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, cells.xy))) return;
    if (tiles[(cell.y >> 1) * offsets.y + (cell.x >> 1)].y == 0u) {
        imageStore(statistics, cell, vec4(0.0));
        return;
    }
    vec2 u = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 c = min(2 * cell + ivec2(i & 1, i >> 1), cells.zw - 1);
        u += patches[offsets.x + c.y * cells.z + c.x].xy;
    }
    imageStore(statistics, cell,
               vec4(spreadOf(levelOf(video), levelOf(still), cell, 0.5 * 0.25 * u), 0.0));
}
