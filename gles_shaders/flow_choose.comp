// Cells at depth edges choose among the flow of their neighbours; see kOtherSurface.
// In: states of the tiles, video, luma of the still with amplified finest detail, cells[] with the
// flow and, if there are any, the ErrorCells.
// Out: chosen[], for each cell: flow, 1 if the cell is compared with the still (otherwise 0), 0.
// One workgroup per tile, one invocation per cell. Most loops count from cell.x or cell.y, so that
// compilers cannot unroll them. If they were unrolled, registers would be spilled.
// Range: chosen -2e4..2e4, -2e4..2e4, 0..1, 0..1
#include "luma.glsl"
#include "rig.glsl"
#include "still_linear.glsl"
#include "pipeline/engine/params/flow.h"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    ChooseFlow params;
};
layout(std430, binding = 1) readonly buffer Cells {
    vec4 cells[];
};
layout(std430, binding = 2) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];
};
layout(std430, binding = 3) writeonly buffer Chosen {
    vec4 chosen[];
};
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D still;

#include "flow_cells.glsl"
#include "flow_place.glsl"

const int kOwn = 4;  // bit of the cell itself

bool isCompared(ivec2 c) {
    if (any(lessThan(c, ivec2(0)))) return false;
    if (any(greaterThan(4 * c + 4, ivec2(params.videoWidth, params.videoHeight)))) return false;
    if (tiles[(c.y / 4) * int(gl_NumWorkGroups.x) + c.x / 4].y == 0u) return false;
    return params.errors < 0 || cells[params.errors + c.y * params.columns + c.x].x < kNotShown;
}

// Returns the cells to compare with: those neighbours whose flow differs from that of the cell, and
// the cell itself if there are such neighbours. The neighbour in column i and row j of the 3x3
// cells has the bit 3 j + i.
int stepsAround(ivec2 cell, vec2 u) {
    int steps = 0;
    for (int i = cell.x; i < cell.x + 9; ++i) {
        int k = i - cell.x;
        ivec2 c = cell + ivec2(k % 3, k / 3) - 1;
        vec2 d = flowAt(c) - u;
        // The comparison is also false if one of the vectors is NaN.
        if (dot(d, d) > kOtherSurface * kOtherSurface && isCompared(c)) steps |= 1 << k;
    }
    return steps == 0 ? 0 : steps | 1 << kOwn;
}

// Returns the still's luma as the video sees it at pixel `p` of the cell [grey levels]: the mean of
// 2x2 samples. params.light determines the kind of mean: 0: of grey levels, 1: of light.
float seenAt(ivec2 cell, ivec2 p, Place place, vec2 size) {
    float seen = 0.0, squares = 0.0;
    for (int j = cell.x; j < cell.x + 4; ++j) {
        ivec2 q = ivec2((j - cell.x) % 2, (j - cell.x) / 2);
        vec2 o = vec2(p) - 1.5 + 0.5 * (vec2(q) - 0.5);
        vec2 r = clamp(place.centre + o.x * place.alongX + o.y * place.alongY, vec2(0.0), size - 1.0);
        float value = linearly(still, (r + 0.5) / size);
        seen += value;
        squares += value * value;
    }
    return 255.0 * mix(0.25 * seen, sqrt(0.25 * squares), params.light);
}

// Returns the sum of the squared differences of luma between the cell and the still at flow `u`
// [grey levels^2], or -1 if the cell's centre is outside the still.
float errorAt(ivec2 cell, vec2 u) {
    vec2 size = vec2(1.0) / vec2(params.texelX, params.texelY);
    Place place = placeOf(cell, u, vec2(0.0), vec2(0.0));
    if (!isInside(place, size)) return -1.0;
    float sum = 0.0;
    for (int i = cell.y; i < cell.y + 16; ++i) {
        ivec2 p = ivec2((i - cell.y) % 4, (i - cell.y) / 4);
        float v = 255.0 * lumaOf(texelFetch(picture, 4 * cell + p, 0).rgb);
        float off = v - seenAt(cell, p, place, size);
        sum += off * off;
    }
    return sum;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    vec2 u = flowAt(cell), best = u;
    bool compared = isCompared(cell);
    float own = -1.0, least = 1e9;
    for (int steps = compared ? stepsAround(cell, u) : 0; steps != 0; steps &= steps - 1) {
        int k = findLSB(steps);
        vec2 candidate = flowAt(cell + ivec2(k % 3, k / 3) - 1);
        float error = errorAt(cell, candidate);
        if (k == kOwn) {
            own = error;
        } else if (error >= 0.0 && error < least) {
            least = error;
            best = candidate;
        }
    }
    float noise = 16.0 * (params.noise * params.noise + kChoiceVariance);
    bool takes = own >= 0.0 && least + noise < kClearlyBetter * (own + noise);
    chosen[cell.y * params.columns + cell.x] = vec4(takes ? best : u, compared ? 1.0 : 0.0, 0.0);
}
