// Interpolates LookUpCells between the centres of cells.
#include "pipeline/engine/params/weigh.h"

// Returns LookUpCell::confidenceAndJumps of the four cells around the video pixel position `p`:
// below left, below right, above right, above left.
vec4 codesAround(sampler2D field, vec2 p, ivec2 count) {
    return textureGather(field, 0.25 * p / vec2(count), 3);
}

// True if the flow jumps between any of these cells or to one of their neighbours.
bool flowJumps(sampler2D field, vec2 p, ivec2 count) {
    return any(greaterThanEqual(codesAround(field, p, count), vec4(kJumpRight)));
}

// Returns offset (x, y) [still px], weight and confidence at the video pixel position `p`. Across a
// jump of the flow (see kJump), the nearer cell counts alone. `count`: columns and rows of cells.
vec4 lookUpCells(sampler2D field, vec2 p, ivec2 count) {
    vec2 size = vec2(count), uv = 0.25 * p / size;
    vec4 codes = codesAround(field, p, count), jumps = floor(codes / kJumpRight);
    if (jumps == vec4(0.0)) return textureLod(field, uv, 0.0);
    vec2 at = 0.25 * p - 0.5, first = floor(at), t = at - first, near = step(0.5, t);
    vec2 across = mix(t.xx, near.xx, mod(jumps.wx, 2.0));
    float down = (near.x > 0.5 ? jumps.z : jumps.w) > 1.5 ? near.y : t.y;
    vec4 upper = textureLod(field, (first + vec2(across.x, 0.0) + 0.5) / size, 0.0);
    vec4 lower = textureLod(field, (first + vec2(across.y, 1.0) + 0.5) / size, 0.0);
    codes -= kJumpRight * jumps;
    vec2 confidences = mix(codes.wx, codes.zy, across);
    return vec4(mix(upper.xyz, lower.xyz, down), mix(confidences.x, confidences.y, down));
}
