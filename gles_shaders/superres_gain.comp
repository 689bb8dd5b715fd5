// Computes the statistics for the photometric gain between the sensors, at half resolution, where
// the difference between the sensors' blur is negligible.
// In: forward field (from video to still), second luma pyramid level of both pictures.
// Out: covariance, variance of the video and variance of the still, for each half-resolution cell
// (8x8 video pixels); zero in tiles that are not matched.
// Range: statistics -4.2e6..4.2e6, 0..4.2e6, 0..4.2e6, 0..0
#include "luma.glsl"
#include "pipeline/engine/params/weigh.h"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    MeasureGain params;
};
layout(std430, binding = 0) readonly buffer Luma {
    uint luma[];
};
layout(std430, binding = 1) readonly buffer Cells {
    vec4 cells[];
};
layout(std430, binding = 2) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];
};
layout(rgba32f, binding = 0) uniform writeonly highp image2D statistics;

#include "patch.glsl"

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    if (tiles[(cell.y >> 1) * params.tileColumns + (cell.x >> 1)].y == 0u) {
        imageStore(statistics, cell, vec4(0.0));
        return;
    }
    ivec2 last = ivec2(params.forwardColumns, params.forwardRows) - 1;
    vec2 u = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 c = min(2 * cell + ivec2(i & 1, i >> 1), last);
        u += cells[params.forward + c.y * params.forwardColumns + c.x].xy;
    }
    imageStore(statistics, cell,
               vec4(spreadOf(params.video, params.still, cell, 0.5 * 0.25 * u), 0.0));
}
