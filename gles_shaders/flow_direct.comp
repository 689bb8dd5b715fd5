// The search compares the video with a still that is reduced to the video's resolution. This shader
// compares doubtful cells with the still itself; see kPatchSamples.
// If the still fits clearly better at the flow that the search along epipolar lines found, that
// flow replaces the cell's flow. If the correlation exceeds 1 - c, where c is the search's cost,
// the cell's ErrorCell gets the sums of the new comparison. The ErrorCell's two-way error is then
// reduced to the error that kErrorPerCost gives for the cost 1 - correlation, unless it is smaller
// already.
// In: states of the tiles, video, luma of the still with amplified finest detail; in cells[], the
// flow along epipolar lines. In, out: cells[], the filtered forward field and its ErrorCells.
// One workgroup per tile, one invocation per cell. Most loops count from cell.x or cell.y, so that
// compilers cannot unroll them. If they were unrolled, registers would be spilled.
// Range: cells -2e4..2e4, -4.2e6..4.2e6, 0..4.2e6, 0..4.2e6
#include "luma.glsl"
#include "rig.glsl"
#include "still_linear.glsl"
#include "patch_start.glsl"
#include "pipeline/engine/params/flow.h"
#include "pipeline/engine/params/weigh.h"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    CompareDirectly params;
};
layout(std430, binding = 1) buffer Cells {
    vec4 cells[];
};
layout(std430, binding = 2) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];
};
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D still;

const int kSide = 8;

#include "flow_cells.glsl"

bool isInside(ivec2 c) {
    return all(greaterThanEqual(c, ivec2(0))) && all(lessThan(c, ivec2(params.columns, params.rows)));
}

// Returns the flow that the search along epipolar lines found, smoothed around the cell; see
// kPairReach.
vec2 lineOf(ivec2 cell) {
    vec2 middle = medianAround(cell), sum = vec2(0.0);
    float weight = 1.0;
    const int kWidth = 2 * kCleanUpRadius + 1, kPairs = (kWidth * kWidth - 1) / 2;
    for (int i = cell.x; i < cell.x + kPairs; ++i) {
        int n = i - cell.x + 1 + kPairs;
        ivec2 by = ivec2(n % kWidth, n / kWidth) - kCleanUpRadius;
        if (!isInside(cell + by) || !isInside(cell - by)) continue;
        vec2 d = 0.5 * (flowAt(cell + by) + flowAt(cell - by)) - middle;
        float near = max(1.0 - dot(d, d) / (kPairReach * kPairReach), 0.0);
        if (!(near > 0.0)) continue;
        weight += near;
        sum += near * d;
    }
    return middle + sum / weight;
}

// Compares the cell's patch with the still at the flow `u`. The flow changes by `dx` per pixel to
// the right and by `dy` per pixel downwards. Returns covariance, variance in the video and variance
// in the still, as sums over the pixels, and the squared correlation. The correlation takes noise
// into account, and is 0 if the covariance is negative. All values are 0 if the patch's centre is
// outside the still.
vec4 compared(ivec2 cell, vec2 u, vec2 dx, vec2 dy) {
    vec2 size = vec2(1.0) / vec2(params.texelX, params.texelY);
    ivec2 video = ivec2(params.videoWidth, params.videoHeight);
    // Positions in the still. `at`: the patch's centre. `right` and `below`: the points one cell to
    // the right of the centre and one cell below it.
    vec2 at = vec2(0.0), right = vec2(0.0), below = vec2(0.0);
    for (int i = cell.x; i < cell.x + 3; ++i) {
        below = right;
        right = at;
        vec2 by = i == cell.x ? vec2(0.0, 1.0) + dy : vec2(1.0, 0.0) + dx;
        vec2 shift = vec2(patchShift(cell, video));
        by = (i == cell.x + 2 ? vec2(0.0) : 4.0 * by) + shift + shift.x * dx + shift.y * dy;
        at = stillPixel(params.rig, 4.0 * vec2(cell) + 1.5 + u + by);
    }
    if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, size - 1.0)))) return vec4(0.0);
    vec2 alongX = 0.25 * (right - at), alongY = 0.25 * (below - at);
    vec2 sum = vec2(0.0);
    vec3 squares = vec3(0.0);
    int end = cell.y + kSide * kSide, samples = cell.x + kPatchSamples * kPatchSamples;
    for (int i = cell.y; i < end; ++i) {
        ivec2 p = ivec2((i - cell.y) % kSide, (i - cell.y) / kSide);
        float seen = 0.0;
        for (int j = cell.x; j < samples; ++j) {
            int k = j - cell.x;
            vec2 o = vec2(p) + (vec2(k % kPatchSamples, k / kPatchSamples) + 0.5) / float(kPatchSamples);
            o -= 0.5 * float(kSide);
            vec2 q = clamp(at + o.x * alongX + o.y * alongY, vec2(0.0), size - 1.0);
            seen += linearly(still, (q + 0.5) / size);
        }
        // 128 is subtracted, because small numbers have small rounding errors.
        seen = 255.0 * seen / float(kPatchSamples * kPatchSamples) - 128.0;
        float given = 255.0 * lumaOf(texelFetch(picture, min(patchStart(cell, video) + p, video - 1), 0).rgb) - 128.0;
        sum += vec2(given, seen);
        squares += vec3(given * seen, given * given, seen * seen);
    }
    vec3 spread = squares - vec3(sum.x * sum.y, sum * sum) / kPatchPixels;
    float noise = kPatchPixels * (params.noise * params.noise + kByteVariance);
    vec2 variances = max(spread.yz, vec2(0.0)) + noise;
    float both = max(spread.x, 0.0);
    return vec4(spread.x, max(spread.yz, vec2(0.0)), both * both / (variances.x * variances.y));
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    if (tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x].y == 0u) return;
    int index = cell.y * params.columns + cell.x;
    vec4 flow = cells[params.target + index];
    float error = cells[params.errors + index].x;
    bool doubtful = error < kNotShown && flow.w > params.leastTexture && (flow.z > kGoodCost || error > 0.0);
    if (!doubtful) return;
    vec2 line = lineOf(cell), u = flow.xy, best = u;
    vec2 dx = slopeAt(cell, ivec2(1, 0)), dy = slopeAt(cell, ivec2(0, 1));
    // Compares the cell's flow, then the flow along the line unless both are almost the same. The
    // loop contains only one call of compared(), which keeps the shader short.
    vec4 alike = vec4(0.0);
    for (int k = cell.x; k < cell.x + 2; ++k) {
        vec4 other = compared(cell, u, dx, dy);
        if (k == cell.x || other.w > alike.w + kClearlyAlike) {
            alike = other;
            best = u;
        }
        if (!(dot(line - u, line - u) > kSameFlow * kSameFlow)) break;
        u = line;
    }
    cells[params.target + index].xy = best;
    float known = max(1.0 - flow.z, 0.0);
    if (!(alike.w > known * known)) return;
    float most = max(1.0 - sqrt(alike.w) - kGoodCost, 0.0) * kErrorPerCost;
    cells[params.errors + index] = vec4(min(error, most), alike.xyz);
}
