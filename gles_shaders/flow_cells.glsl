// Reads a flow field in cells[]. The shader must declare cells[] and params (source, columns,
// rows).
vec4 cellIn(ivec2 c) {
    c = clamp(c, ivec2(0), ivec2(params.columns, params.rows) - 1);
    return cells[params.source + c.y * params.columns + c.x];
}

vec2 flowAt(ivec2 c) {
    return cellIn(c).xy;
}

// Returns the change of the flow per pixel along `step`, for each component: the smaller of the two
// one-sided differences, at most kSteepestFlow in magnitude, or zero if they have different signs.
// The differences span two cells, because between adjacent cells noise exceeds the true change. A
// cell at the border has the change of the nearest cell with both differences.
vec2 slopeAt(ivec2 cell, ivec2 step) {
    cell = max(min(cell, ivec2(params.columns, params.rows) - 1 - 2 * step), 2 * step);
    vec2 here = flowAt(cell);
    vec2 before = here - flowAt(cell - 2 * step), after = flowAt(cell + 2 * step) - here;
    vec2 least = sign(after) * min(abs(before), abs(after));
    return clamp(mix(vec2(0.0), least / 8.0, greaterThan(before * after, vec2(0.0))), -kSteepestFlow, kSteepestFlow);
}

void order(inout vec2 a, inout vec2 b) {
    vec2 low = min(a, b);
    b = max(a, b);
    a = low;
}

// Returns the medians of x and of y over 3x3 cells. Each column of three values is sorted first.
// The result is the median of three values: the largest of the low values, the median of the middle
// values, and the smallest of the high values.
vec2 medianAround(ivec2 cell) {
    vec2 low = vec2(-1e9), high = vec2(1e9), middle = vec2(0.0), least = vec2(1e9), most = vec2(-1e9);
    for (int x = cell.x - 1; x < cell.x + 2; ++x) {
        vec2 a = flowAt(ivec2(x, cell.y - 1)), b = flowAt(ivec2(x, cell.y)), c = flowAt(ivec2(x, cell.y + 1));
        order(a, b);
        order(b, c);
        order(a, b);
        low = max(low, a);
        high = min(high, c);
        // In the last iteration, `middle` becomes the median of the columns' middle values.
        middle = max(least, min(most, b));
        least = min(least, b);
        most = max(most, b);
    }
    order(low, middle);
    order(middle, high);
    return max(low, middle);
}
