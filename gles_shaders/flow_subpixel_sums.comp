// Compares each cell with the still at its full resolution, for flow_subpixel.comp; see
// kSubpixelReach.
// In: video, luma of the still with amplified finest detail, chosen[] of flow_choose.comp as
// cells[].
// Out: four entries of sums[] per cell. v: luma of the video. s: luma of the still at the cell's
// flow. x, y: derivatives of s with respect to the flow. For example, VX is the sum of v x over the
// cell's 16 pixels minus 16 (mean of v) (mean of x).
//   [0]: VS, SS, VX, VY  [1]: SX, SY, XX, XY  [2]: YY, VV, flow  [3]: change of the flow along x, y
// All sums are 0 for cells that are not compared.
// One workgroup per tile, one invocation per cell. The loops count from cell.x or cell.y, so that
// compilers cannot unroll them. If they were unrolled, registers would be spilled.
// Range: sums -4.2e6..4.2e6, -4.2e6..4.2e6, -4.2e6..4.2e6, -4.2e6..4.2e6
#include "luma.glsl"
#include "rig.glsl"
#include "still_linear.glsl"
#include "pipeline/engine/params/flow.h"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    SumSubpixel params;
};
layout(std430, binding = 1) readonly buffer Cells {
    vec4 cells[];
};
layout(std430, binding = 2) writeonly buffer Sums {
    vec4 sums[];
};
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D still;

#include "flow_cells.glsl"
#include "flow_place.glsl"

// Returns the still's luma at pixel `p` of the cell and its derivatives along x and y [grey
// levels]. The still is sampled at 4x4 positions around the pixel, half a pixel apart, without the
// four corners. The mean of the middle 2x2 samples is the luma. The derivative along x is the mean
// of the 2x2 samples half a pixel to the right minus the mean of the 2x2 samples half a pixel to
// the left. The derivative along y is computed in the same way. params.light determines the kind of
// mean: 0: of grey levels, 1: of light; see kSubpixelReach.
vec3 seenAt(ivec2 cell, ivec2 p, Place place, vec2 size) {
    vec3 seen = vec3(0.0), squares = vec3(0.0);
    for (int j = cell.x; j < cell.x + 16; ++j) {
        ivec2 q = ivec2((j - cell.x) % 4, (j - cell.x) / 4);
        bvec2 middle = equal(abs(2 * q - 3), ivec2(1));
        if (!any(middle)) continue;
        vec2 o = vec2(p) - 1.5 + 0.5 * (vec2(q) - 1.5);
        vec2 r = clamp(place.centre + o.x * place.alongX + o.y * place.alongY, vec2(0.0), size - 1.0);
        vec2 side = vec2(middle.yx) * sign(vec2(q) - 1.5);
        float value = linearly(still, (r + 0.5) / size);
        vec3 counts = vec3(all(middle) ? 1.0 : 0.0, side);
        seen += value * counts;
        squares += value * value * counts;
    }
    float root = sqrt(0.25 * squares.x);
    vec3 ofLight = vec3(root, squares.yz / (8.0 * max(root, 1.0 / 255.0)));
    return 255.0 * mix(0.25 * seen, ofLight, params.light);
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    int index = cell.y * params.columns + cell.x;
    vec2 u = flowAt(cell), dx = slopeAt(cell, ivec2(1, 0)), dy = slopeAt(cell, ivec2(0, 1));
    vec4 products = vec4(0.0), derivatives = vec4(0.0), means = vec4(0.0);
    vec2 squares = vec2(0.0);
    vec2 size = vec2(1.0) / vec2(params.texelX, params.texelY);
    Place place = placeOf(cell, u, dx, dy);
    bool isCompared = cells[params.source + index].z > 0.0;
    int pixels = isCompared && isInside(place, size) ? 16 : 0;
    for (int i = cell.y; i < cell.y + pixels; ++i) {
        ivec2 p = ivec2((i - cell.y) % 4, (i - cell.y) / 4);
        // 128 is subtracted, because small numbers have small rounding errors.
        vec3 s = seenAt(cell, p, place, size) - vec3(128.0, 0.0, 0.0);
        float v = 255.0 * lumaOf(texelFetch(picture, 4 * cell + p, 0).rgb) - 128.0;
        means += vec4(v, s);
        products += vec4(v, s.x, v, v) * vec4(s.xx, s.yz);
        derivatives += s.xxyy * s.yzyz;
        squares += vec2(s.z * s.z, v * v);
    }
    means *= 0.25;
    sums[4 * index] = products - vec4(means.x, means.y, means.xx) * vec4(means.yy, means.zw);
    sums[4 * index + 1] = derivatives - means.yyzz * means.zwzw;
    sums[4 * index + 2] = vec4(squares - means.wx * means.wx, u);
    sums[4 * index + 3] = vec4(dx, dy);
}
