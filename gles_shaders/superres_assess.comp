// Computes statistics of the match between still and video in each cell, for superres_weigh.comp.
// In: luma[]: the finest pyramid level of both pictures. cells[]: the forward field (from video to
// still), and either ErrorCells or the backward field, which may be of a coarser pyramid level.
// Out: displacement image = flow (x, y) [video px], and offset (x, y) of LookUpCell [still px].
// Statistics image = covariance, variance of the video, variance of the still, confidence. The
// first three are sums over the patch. If the covariance in the cell's ErrorCell is above 0, they
// are copied from there. Otherwise, they are computed if the tile is matched, and 0 if it is not.
// Source: eq. 2 of the paper (docs/paper.md), with lambda(x) = min(x, 1).
// Range: displacement -2e4..2e4, -2e4..2e4, -4e3..4e3, -4e3..4e3
// Range: statistics -4.2e6..4.2e6, 0..4.2e6, 0..4.2e6, 0..1
#include "luma.glsl"
#include "rig.glsl"
#include "pipeline/engine/params/weigh.h"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    AssessCells params;
};
layout(std430, binding = 0) readonly buffer Luma {
    uint luma[];
};
layout(std430, binding = 1) readonly buffer Cells {
    vec4 cells[];
};
layout(std430, binding = 2) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];  // for each tile (workgroup): x = 1 if it changed, y = 1 if it is matched
};
layout(rgba32f, binding = 0) uniform writeonly highp image2D displacement;
layout(rgba32f, binding = 1) uniform writeonly highp image2D statistics;

#include "patch.glsl"

vec2 backward(ivec2 c) {
    c = clamp(c, ivec2(0), ivec2(params.backwardColumns, params.backwardRows) - 1);
    return float(params.backwardScale) * cells[params.backward + c.y * params.backwardColumns + c.x].xy;
}

vec2 backwardAt(vec2 p) {
    vec2 g = (p + 0.5) / float(4 * params.backwardScale) - 0.5;
    ivec2 i = ivec2(floor(g));
    vec2 f = g - floor(g);
    vec2 top = mix(backward(i), backward(i + ivec2(1, 0)), f.x);
    vec2 bottom = mix(backward(i + ivec2(0, 1)), backward(i + ivec2(1, 1)), f.x);
    return mix(top, bottom, f.y);
}

bool inside(vec2 p, vec2 size) {
    return p.x >= 0.0 && p.y >= 0.0 && p.x <= size.x - 1.0 && p.y <= size.y - 1.0;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    int index = cell.y * params.columns + cell.x;
    vec2 u = cells[params.forward + index].xy;

    vec2 centre = 4.0 * vec2(cell) + 1.5;
    vec2 q = centre + u;
    vec2 inStill = stillPixel(params.rig, q);
    float confidence = 0.0;
    if (inside(q, vec2(params.video.width, params.video.height)) &&
        inside(inStill, vec2(params.stillWidth, params.stillHeight))) {
        float d = params.errorsGiven != 0 ? cells[params.backward + index].x : length(u + backwardAt(q));
        confidence = d < kTwoWayAlpha ? 1.0 - d / kTwoWayAlpha : 0.0;
    }

    vec2 scale = vec2(params.scaleX, params.scaleY);
    vec2 offset = clamp(inStill - (centre + 0.5) * scale + 0.5, vec2(-kFarthestOffset), vec2(kFarthestOffset));
    vec3 direct = params.errorsGiven != 0 ? cells[params.backward + index].yzw : vec3(0.0);
    // The call of spreadOf() must come last, because it contains a loop. If the loop precedes the
    // rest, the compiler of Mesa 22.3 for V3D does not terminate.
    vec3 alike = vec3(0.0);
    if (tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x].y != 0u)
        alike = spreadOf(params.video, params.still, cell, u);
    if (direct.x > 0.0) alike = direct;
    imageStore(displacement, cell, vec4(u, offset));
    imageStore(statistics, cell, vec4(alike, confidence));
}
