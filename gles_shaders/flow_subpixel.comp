// Corrects the flow of the cells in matched tiles by one Gauss-Newton step; see kSubpixelReach.
// In: states of the tiles, sums[] of flow_subpixel_sums.comp. Out: the flow in cells[].
// One workgroup per tile, one invocation per cell.
// Range: cells -2e4..2e4, -4.2e6..4.2e6, 0..4.2e6, 0..4.2e6
#include "pipeline/engine/params/flow.h"
#include "pipeline/engine/params/weigh.h"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    CorrectSubpixel params;
};
layout(std430, binding = 1) buffer Cells {
    vec4 cells[];
};
layout(std430, binding = 2) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];
};
layout(std430, binding = 3) readonly buffer Sums {
    vec4 sums[];
};

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy), last = ivec2(params.columns, params.rows) - 1;
    if (any(greaterThan(cell, last))) return;
    if (tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x].y == 0u) return;
    int index = cell.y * params.columns + cell.x;
    vec2 u = sums[4 * index + 2].zw;
    vec4 slopes = sums[4 * index + 3], products = vec4(0.0), derivatives = vec4(0.0);
    vec2 squares = vec2(0.0), away = vec2(0.0);  // away: derivative products times the difference d
    for (int k = cell.x; k < cell.x + 9; ++k) {
        ivec2 by = ivec2((k - cell.x) % 3, (k - cell.x) / 3) - 1;
        ivec2 c = cell + by;
        if (any(lessThan(c, ivec2(0))) || any(greaterThan(c, last))) continue;
        int n = 4 * (c.y * params.columns + c.x);
        vec4 other = sums[n + 2];
        vec2 d = other.zw - u - 4.0 * (float(by.x) * slopes.xy + float(by.y) * slopes.zw);
        float off = dot(d, d) / (kSubpixelReach * kSubpixelReach);
        // The comparison is also false if the neighbour's flow is NaN.
        if (!(off < 1.0)) continue;
        float weight = float((2 - abs(by.x)) * (2 - abs(by.y))) * (1.0 - off);
        vec4 ofStill = weight * sums[n + 1];
        vec2 ofSquares = weight * other.xy;
        products += weight * sums[n];
        derivatives += ofStill;
        squares += ofSquares;
        away += d.x * ofStill.zw + d.y * vec2(ofStill.w, ofSquares.x);
    }
    float noise = kSubpixelPixels * (params.noise * params.noise + kByteVariance);
    float gain = products.x / (products.y + noise);
    vec2 error = gain * (products.zw + gain * (away - derivatives.xy));
    float xx = gain * gain * derivatives.z, xy = gain * gain * derivatives.w, yy = gain * gain * squares.x;
    float unexplained = max(squares.y - gain * products.x, 0.0);
    float damping = (unexplained + noise) / (kSubpixelPixels * kSubpixelError * kSubpixelError);
    xx += damping;
    yy += damping;
    vec2 correction = vec2(yy * error.x - xy * error.y, xx * error.y - xy * error.x) / (xx * yy - xy * xy);
    bool takes = gain >= kLeastSubpixelGain && dot(correction, correction) < kSubpixelLongest * kSubpixelLongest;
    cells[params.target + index].xy = takes ? u + correction : u;
}
