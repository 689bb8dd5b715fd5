// Filters of the learned enlarger. Needs cubic.glsl.
// The texture has one row per class. For each pair of taps, the row has four texels, one for each
// row of the pixel's 4x4 sub-pixels. A texel has four channels, one for each sub-pixel in that row.
// A channel has the weights of both taps, divided by two, as half floats.
layout(binding = 1) uniform usampler2D filters;

// Differences of luma have at most eleven bits, so half floats represent them exactly. Half floats
// need half as many registers as floats.
uvec2 halvesOf(vec4 v) {
    return uvec2(packHalf2x16(v.xy), packHalf2x16(v.zw));
}
vec4 floatsOf(uvec2 v) {
    return vec4(unpackHalf2x16(v.x), unpackHalf2x16(v.y));
}

// Returns the contribution of a pair of taps to the four sub-pixels of a row. It is the mean of the
// contributions by the filters of both classes: they are added, and the stored weights are already
// divided by two. `at`: index of the pair's texel for this row. `taps`: luma differences of the two
// taps.
vec4 pairOf(ivec2 classes, int at, uint taps) {
    uvec4 a = texelFetch(filters, ivec2(at, classes.x), 0), b = texelFetch(filters, ivec2(at, classes.y), 0);
    vec2 steps = unpackHalf2x16(taps);
    return vec4(dot(unpackHalf2x16(a.x) + unpackHalf2x16(b.x), steps),
                dot(unpackHalf2x16(a.y) + unpackHalf2x16(b.y), steps),
                dot(unpackHalf2x16(a.z) + unpackHalf2x16(b.z), steps),
                dot(unpackHalf2x16(a.w) + unpackHalf2x16(b.w), steps));
}

// Returns four of the pixel's 4x4 sub-pixels, those of the given row: enlarged by Keys' cubic
// (along columns first), minus the pixel's value. The taps are in the order of kTapAt in
// pipeline/enlarge/filter_layout.h.
vec4 cubicOf(int row, uvec4 above, uvec4 below, uvec4 beside) {
    vec4 w = cubicWeights(fract(0.625 + 0.25 * float(row)));
    vec4 upper = row < 2 ? w : vec4(0.0, w.xyz);
    float lower = row < 2 ? 0.0 : w.w;
    vec4 sides = floatsOf(beside.xy), ends = floatsOf(beside.zw);
    vec4 column = upper.x * floatsOf(above.xy) + upper.y * floatsOf(above.zw) + upper.w * floatsOf(below.xy) +
                  lower * floatsOf(below.zw) + upper.z * vec4(sides.xy, 0.0, sides.z);
    float last = dot(upper, vec4(ends.xy, sides.w, ends.z)) + lower * ends.w;
    vec4 shifted = vec4(column.yzw, last);
    return vec4(dot(cubicWeights(0.625), column), dot(cubicWeights(0.875), column),
                dot(cubicWeights(0.125), shifted), dot(cubicWeights(0.375), shifted));
}

vec4 residualOf(ivec2 classes, int row, uvec4 above, uvec4 below, uvec4 beside) {
    vec4 sum = pairOf(classes, row, above.x);
    sum += pairOf(classes, row + 4, above.y);
    sum += pairOf(classes, row + 8, above.z);
    sum += pairOf(classes, row + 12, above.w);
    sum += pairOf(classes, row + 16, below.x);
    sum += pairOf(classes, row + 20, below.y);
    sum += pairOf(classes, row + 24, below.z);
    sum += pairOf(classes, row + 28, below.w);
    sum += pairOf(classes, row + 32, beside.x);
    sum += pairOf(classes, row + 36, beside.y);
    sum += pairOf(classes, row + 40, beside.z);
    sum += pairOf(classes, row + 44, beside.w);
    return sum;
}
