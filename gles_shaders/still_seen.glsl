// Computes the mean luma of the still over the area of a video pixel. Needs tile_params.glsl.
#include "look_up_cells.glsl"
layout(binding = 2) uniform sampler2D lookupField;
layout(binding = 3) uniform sampler2D still;

// Returns the position in the still, in texture coordinates, of video position `p` with `offset`.
vec2 inStill(vec2 p, vec2 offset) {
    vec2 scale = vec2(params.stillScaleX, params.stillScaleY) / vec2(params.scaleX, params.scaleY);
    return (p * scale + offset) * vec2(params.stillTexelX, params.stillTexelY);
}

// Returns the position of this pixel's corner sample (x, y), each -1 or 1. `jumps`: the flow jumps
// near the pixel. Then, the whole pixel has the offset `middle`.
vec2 cornerInStill(vec2 corner, bool jumps, vec2 middle) {
    vec2 p = gl_FragCoord.xy + 0.375 * kSeen * corner;
    return inStill(p, jumps ? middle : textureLod(lookupField, p / vec2(4 * cellCount()), 0.0).xy);
}

// Returns the mean of 4x4 samples of the still over this video pixel (x), and the mean of their
// squares (y). The positions between the four corner samples are interpolated bilinearly.
vec2 stillMeans() {
    bool jumps = flowJumps(lookupField, gl_FragCoord.xy, cellCount());
    vec2 middle = jumps ? lookUpCells(lookupField, gl_FragCoord.xy, cellCount()).xy : vec2(0.0);
    vec2 first = cornerInStill(vec2(-1.0), jumps, middle), last = cornerInStill(vec2(1.0), jumps, middle);
    vec2 right = cornerInStill(vec2(1.0, -1.0), jumps, middle);
    vec2 below = cornerInStill(vec2(-1.0, 1.0), jumps, middle);
    vec2 sums = vec2(0.0);
    for (int i = 0; i < 16; ++i) {
        vec2 share = vec2(i & 3, i >> 2) / 3.0;
        vec2 at = mix(mix(first, right, share.x), mix(below, last, share.x), share.y);
        float value = textureLod(still, at, 0.0).r;
        sums += vec2(value, value * value);
    }
    return sums / 16.0;
}
