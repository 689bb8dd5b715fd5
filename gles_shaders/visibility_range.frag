// A virtual surface in front of all nearby samples of the real depth is visible. A surface behind
// all of them is occluded. Finds the inverse depths between these two cases, for which
// visibility_sample.frag must weigh the samples. Pixel (x, y) of the result is for the 4x4 samples
// at the video pixels from (x - 1, y - 1) to (x + 2, y + 2).
// In: inverse depth and sigma of the real scene [1/m], Rg32F.
// Out: x: virtual surfaces with at least this inverse depth are in front of every sample. y:
// virtual surfaces with at most this inverse depth would be occluded by every sample if their own
// depth were exact (see visibility_decide.frag); 0: there are no such surfaces.
// Range: range 0..1e6, 0..1e6
#include "visibility.glsl"

layout(binding = 0) uniform sampler2D realDepth;
layout(location = 0) out vec2 range;

void main() {
    range = vec2(0.0, kMostInverseDepth);
    for (int i = 0; i < 16; ++i) {
        ivec2 q = ivec2(gl_FragCoord.xy) + ivec2(i & 3, i >> 2) - 1;
        vec2 real = texelFetch(realDepth, clamp(q, ivec2(0), lastVideoPixel()), 0).rg;
        bool is = known(real);
        range.x = max(range.x, is ? real.x - params.bias * real.y : 0.0);
        range.y = min(range.y, is ? max(real.x - (params.bias + params.softness) * real.y, 0.0) : 0.0);
    }
}
