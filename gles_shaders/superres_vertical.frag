// First half of the enlargement: along columns, all four channels, by Keys' cubic. composite_*.frag
// enlarge along rows. LINEAR: enlarges by linear interpolation instead.
// In: the video, or the result of superres_sharpen.frag, whose alpha is the mean luma of the still.
// Out: a picture with the video's width and the output's height.
// LEARNED: the inputs are the video (not sharpened), the mean of the still over each video pixel,
// and the residual of superres_enlarge.comp. The outputs are integers [1/64 grey level]. The first
// output is the enlarged video and, in alpha, the enlarged mean of the still. The second output is
// the residual, four sub-pixels per texel.
// Variant: #define LINEAR
// Variant: #define LEARNED
#include "cubic.glsl"

#include "tile_params.glsl"
layout(binding = 0) uniform sampler2D picture;
#ifdef LEARNED
#include "pipeline/engine/params/enlarge.h"
layout(binding = 1) uniform isampler2D seen;
layout(binding = 2) uniform isampler2D grid;
layout(location = 0) out ivec4 colour;
layout(location = 1) out ivec4 residual;

vec4 pictureAt(ivec2 p) {
    return vec4(255.0 * float(kPassScale) * texelFetch(picture, p, 0).rgb, float(texelFetch(seen, p, 0).r));
}

ivec4 residualBetween() {
    float y = float(kGrid) * gl_FragCoord.y * params.scaleY - 0.5;
    int x = int(gl_FragCoord.x), row = int(floor(y)), last = kGrid * params.videoHeight - 1;
    vec4 upper = vec4(texelFetch(grid, ivec2(x, clamp(row, 0, last)), 0));
    vec4 lower = vec4(texelFetch(grid, ivec2(x, clamp(row + 1, 0, last)), 0));
    return ivec4(floor(float(kPassScale / kResidualScale) * mix(upper, lower, y - floor(y)) + 0.5));
}
#else
layout(location = 0) out vec4 colour;

vec4 pictureAt(ivec2 p) {
    return texelFetch(picture, p, 0);
}
#endif

void main() {
    float y = gl_FragCoord.y * params.scaleY - 0.5;
    int x = int(gl_FragCoord.x);
    int row = int(floor(y));
    float t = y - floor(y);
#ifdef LINEAR
    const int first = 1, last = 2;
    vec4 w = vec4(0.0, 1.0 - t, t, 0.0);
#else
    const int first = 0, last = 3;
    vec4 w = cubicWeights(t);
#endif
    vec4 sum = vec4(0.0);
    for (int i = first; i <= last; ++i)
        sum += w[i] * pictureAt(ivec2(x, clamp(row + i - 1, 0, params.videoHeight - 1)));
#ifdef LEARNED
    colour = ivec4(floor(sum + 0.5));
    residual = residualBetween();
#else
    colour = sum;
#endif
}
