// Measures how abruptly the flow changes around a cell. The flow is in the channels x and y of the
// texture `displacement`. The shader must declare this sampler and params (columns, rows).
#include "pipeline/engine/params/weigh.h"

ivec2 lastCell() {
    return ivec2(params.columns, params.rows) - 1;
}

vec2 flowAt(ivec2 c) {
    return texelFetch(displacement, clamp(c, ivec2(0), lastCell()), 0).xy;
}

// Returns the magnitude of the second difference of the flow at the cell [px]. Rotations and zooms
// have a second difference of zero.
float tearAt(ivec2 c) {
    vec2 here = 2.0 * flowAt(c);
    vec2 dx = flowAt(c + ivec2(1, 0)) + flowAt(c - ivec2(1, 0)) - here;
    vec2 dy = flowAt(c + ivec2(0, 1)) + flowAt(c - ivec2(0, 1)) - here;
    return sqrt(dot(dx, dx) + dot(dy, dy));
}

// Returns 0 where the flow is even, 1 where it is bent; see kEvenFlow.
float bentAt(ivec2 c) {
    vec2 dx = flowAt(c + ivec2(1, 0)) - flowAt(c - ivec2(1, 0));
    vec2 dy = flowAt(c + ivec2(0, 1)) - flowAt(c - ivec2(0, 1));
    return smoothstep(kEvenFlow, kBentFlow, sqrt(dot(dx, dx) + dot(dy, dy)) / 8.0);
}
