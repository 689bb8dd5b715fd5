// The flow along epipolar lines around a cell, for flow_direct.comp, which declares cells[] and
// params.
vec2 lineAt(ivec2 c) {
    c = clamp(c, ivec2(0), ivec2(params.columns, params.rows) - 1);
    return cells[params.source + c.y * params.columns + c.x].xy;
}

// As in flow_align.comp.
vec2 slopeAt(ivec2 cell, ivec2 step) {
    vec2 here = lineAt(cell);
    vec2 before = here - lineAt(cell - 2 * step), after = lineAt(cell + 2 * step) - here;
    vec2 least = sign(after) * min(abs(before), abs(after));
    return clamp(mix(vec2(0.0), least / 8.0, greaterThan(before * after, vec2(0.0))), -kSteepestFlow, kSteepestFlow);
}

void order(inout vec2 a, inout vec2 b) {
    vec2 low = min(a, b);
    b = max(a, b);
    a = low;
}

// Returns the median of 3x3 vectors, as flow_filter.comp does: the median of the largest low, the
// middle and the smallest high value of three sorted columns.
vec2 medianAround(ivec2 cell) {
    vec2 low = vec2(-1e9), high = vec2(1e9), middle = vec2(0.0), least = vec2(1e9), most = vec2(-1e9);
    for (int x = cell.x - 1; x < cell.x + 2; ++x) {
        vec2 a = lineAt(ivec2(x, cell.y - 1)), b = lineAt(ivec2(x, cell.y)), c = lineAt(ivec2(x, cell.y + 1));
        order(a, b);
        order(b, c);
        order(a, b);
        low = max(low, a);
        high = min(high, c);
        // In the last iteration, this is the median of the columns' middle values.
        middle = max(least, min(most, b));
        least = min(least, b);
        most = max(most, b);
    }
    order(low, middle);
    order(middle, high);
    return max(low, middle);
}

bool isInside(ivec2 c) {
    return all(greaterThanEqual(c, ivec2(0))) && all(lessThan(c, ivec2(params.columns, params.rows)));
}

// Returns the flow along the epipolar line, see kPairReach.
vec2 lineOf(ivec2 cell) {
    vec2 middle = medianAround(cell), sum = vec2(0.0);
    float weight = 1.0;
    const int kWidth = 2 * kCleanUpRadius + 1, kPairs = (kWidth * kWidth - 1) / 2;
    for (int i = cell.x; i < cell.x + kPairs; ++i) {
        int n = i - cell.x + 1 + kPairs;
        ivec2 by = ivec2(n % kWidth, n / kWidth) - kCleanUpRadius;
        if (!isInside(cell + by) || !isInside(cell - by)) continue;
        vec2 d = 0.5 * (lineAt(cell + by) + lineAt(cell - by)) - middle;
        float near = max(1.0 - dot(d, d) / (kPairReach * kPairReach), 0.0);
        if (!(near > 0.0)) continue;
        weight += near;
        sum += near * d;
    }
    return middle + sum / weight;
}
