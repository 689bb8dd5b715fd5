// Robust clean-up of a cell field: the median of each component over 3x3 cells. Larger windows and
// weighted vector medians measured worse on photographs: they flatten slanted and curved surfaces.
// In, out: two areas of patches[]. One invocation a cell.

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    ivec4 cells;    // cells a row, rows, -, -
    ivec4 offsets;  // in patches[]: output, input, -, -
};
layout(std430, binding = 1) buffer Patches {
    vec4 patches[];
};

vec4 cellIn(ivec2 c) {
    c = clamp(c, ivec2(0), cells.xy - 1);
    return patches[offsets.y + c.y * cells.x + c.x];
}

void order(inout vec2 a, inout vec2 b) {
    vec2 low = min(a, b);
    b = max(a, b);
    a = low;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, cells.xy))) return;
    vec2 v[9];
    for (int i = 0; i < 9; ++i) v[i] = cellIn(cell + ivec2(i % 3 - 1, i / 3 - 1)).xy;
    // Sorts the columns, then takes the middle of (largest low, middle middle, smallest high).
    for (int c = 0; c < 3; ++c) {
        order(v[c], v[c + 3]);
        order(v[c + 3], v[c + 6]);
        order(v[c], v[c + 3]);
    }
    order(v[3], v[4]);
    order(v[4], v[5]);
    order(v[3], v[4]);
    vec2 low = max(max(v[0], v[1]), v[2]), middle = v[4], high = min(min(v[6], v[7]), v[8]);
    order(low, middle);
    order(middle, high);
    order(low, middle);
    patches[offsets.x + cell.y * cells.x + cell.x] = vec4(middle, cellIn(cell).zw);
}
