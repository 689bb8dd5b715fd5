// Compares doubtful cells with the still itself, see kPatchSamples. A cell gets the flow along its
// epipolar line if that fits clearly better. If the comparison finds a better match than the cost
// shows, the cell also gets the sums of the comparison, and its two-way error is at most the one of
// such a match.
// In: states of the tiles, video, luma of the still with amplified finest detail; in cells[], the
// flow along epipolar lines. In, out: cells[], the filtered forward field and its ErrorCells.
// One workgroup per tile, one invocation per cell.
// Range: cells -2e4..2e4, -4.2e6..4.2e6, 0..4.2e6, 0..4.2e6
#include "luma.glsl"
#include "rig.glsl"
#include "still_linear.glsl"
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

// As in flow_filter.comp.
vec2 medianAround(ivec2 cell) {
    vec2 v[9];
    for (int i = 0; i < 9; ++i) v[i] = lineAt(cell + ivec2(i % 3 - 1, i / 3 - 1));
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
    return middle;
}

bool isInside(ivec2 c) {
    return all(greaterThanEqual(c, ivec2(0))) && all(lessThan(c, ivec2(params.columns, params.rows)));
}

// Returns the flow along the epipolar line, see kPairReach.
vec2 lineOf(ivec2 cell) {
    vec2 middle = medianAround(cell), sum = vec2(0.0);
    float weight = 1.0;
    const int kWidth = 2 * kCleanUpRadius + 1, kPairs = (kWidth * kWidth - 1) / 2;
    for (int k = 1; k <= kPairs; ++k) {
        int n = k + kPairs;
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

// Compares the patch at the flow `u`, which changes by dx and dy per pixel, with the still. Returns
// covariance, variance in the video, variance in the still, and the squared correlation. All are 0
// if `u` ends outside the still.
vec4 compared(ivec2 cell, vec2 u, vec2 dx, vec2 dy) {
    vec2 centre = 4.0 * vec2(cell) + 1.5 + u;
    vec2 at = stillPixel(params.rig, centre);
    vec2 size = vec2(1.0) / vec2(params.texelX, params.texelY);
    if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, size - 1.0)))) return vec4(0.0);
    vec2 alongX = 0.25 * (stillPixel(params.rig, centre + 4.0 * (vec2(1.0, 0.0) + dx)) - at);
    vec2 alongY = 0.25 * (stillPixel(params.rig, centre + 4.0 * (vec2(0.0, 1.0) + dy)) - at);
    vec2 sum = vec2(0.0);
    vec3 squares = vec3(0.0);
    ivec2 last = ivec2(params.videoWidth, params.videoHeight) - 1;
    // The compiler does not know the number of iterations, so it does not unroll the loop.
    int end = cell.y + kSide * kSide;
    for (int i = cell.y; i < end; ++i) {
        ivec2 p = ivec2((i - cell.y) % kSide, (i - cell.y) / kSide);
        float seen = 0.0;
        for (int k = 0; k < kPatchSamples * kPatchSamples; ++k) {
            vec2 o = vec2(p) + (vec2(k % kPatchSamples, k / kPatchSamples) + 0.5) / float(kPatchSamples);
            o -= 0.5 * float(kSide);
            vec2 q = clamp(at + o.x * alongX + o.y * alongY, vec2(0.0), size - 1.0);
            seen += linearly(still, (q + 0.5) / size);
        }
        // Small numbers have small rounding errors.
        seen = 255.0 * seen / float(kPatchSamples * kPatchSamples) - 128.0;
        float video = 255.0 * lumaOf(texelFetch(picture, clamp(4 * cell - 2 + p, ivec2(0), last), 0).rgb) - 128.0;
        sum += vec2(video, seen);
        squares += vec3(video * seen, video * video, seen * seen);
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
    vec2 dx = slopeAt(cell, ivec2(1, 0)), dy = slopeAt(cell, ivec2(0, 1));
    vec2 line = lineOf(cell), u = flow.xy, best = u;
    // If both vectors are the same, the second comparison finds the same. A loop keeps the shader
    // short.
    vec4 alike = vec4(0.0);
    for (int k = 0; k < 2; ++k) {
        vec4 other = compared(cell, u, dx, dy);
        if (k == 0 || other.w > alike.w + kClearlyAlike) {
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
