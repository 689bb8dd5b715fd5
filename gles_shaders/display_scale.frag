// Shows a picture on a screen, scaled into a rectangle. The rest of the screen is black.
// Each screen pixel is the mean of the picture over the pixel's footprint, which is at least one
// picture pixel wide. So a picture is averaged without aliasing if it is reduced, interpolated
// linearly if it is enlarged, and copied if it has equal size. Gamma-encoded values are averaged as
// they are stored.
// One texture fetch reads two neighbouring texels along each axis, with weights that the sampling
// position determines. The sampler must therefore filter linearly and clamp to the edge.
// PAIRS: largest number of texel pairs of a footprint along each axis; 0 copies the picture. It is
// a constant, so that the compiler can unroll the loops.
// Variant: #define PAIRS 0
// Variant: #define PAIRS 2
#ifndef PAIRS
#define PAIRS 1
#endif

#include "hal/device/scale_params.h"

layout(std140) uniform Params {
    ScalePicture params;
};
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 colour;

vec2 overlap(float first, float lo, float hi) {
    vec2 begin = vec2(first, first + 1.0);
    return max(min(vec2(hi), begin + 1.0) - max(vec2(lo), begin), 0.0);
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy) - ivec2(params.left, params.top);
    colour = vec4(0.0, 0.0, 0.0, 1.0);
    if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, ivec2(params.width, params.height)))) return;

#if PAIRS == 0
    vec3 sum = texelFetch(picture, p, 0).rgb;
#else
    vec2 footprint = vec2(params.footprintX, params.footprintY);
    vec2 centre = (vec2(p) + 0.5) * vec2(params.scaleX, params.scaleY);
    vec2 lo = centre - 0.5 * footprint, hi = lo + footprint;
    vec2 first = floor(lo), texel = 1.0 / vec2(params.pictureWidth, params.pictureHeight);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < PAIRS; ++j) {
        float y = first.y + float(2 * j);
        vec2 wy = overlap(y, lo.y, hi.y);
        float weightY = wy.x + wy.y;
        for (int i = 0; i < PAIRS; ++i) {
            float x = first.x + float(2 * i);
            vec2 wx = overlap(x, lo.x, hi.x);
            float weightX = wx.x + wx.y;
            // If both texels of an axis are outside the footprint, their sum of weights (weightX or
            // weightY) is zero, and the sampling position does not matter. The limit 1.0e-6 then
            // avoids a division by zero.
            vec2 between = vec2(wx.y, wy.y) / max(vec2(weightX, weightY), 1.0e-6);
            vec2 at = (vec2(x, y) + 0.5 + between) * texel;
            sum += weightX * weightY * textureLod(picture, at, 0.0).rgb;
        }
    }
    sum /= footprint.x * footprint.y;
#endif
    colour.rgb = params.blueFirst == 1 ? sum.bgr : sum;
}
