// Computes the learned enlarger's residual at an output pixel. superres_vertical.frag (variant
// LEARNED) has interpolated along columns; this code interpolates along rows. Needs
// tile_params.glsl.
#include "pipeline/engine/params/enlarge.h"

layout(binding = 0) uniform isampler2D columns;
layout(binding = 3) uniform isampler2D residuals;
// One texel per tile: above 0 if learned filters enlarge the tile, else 0.
layout(binding = 4) uniform sampler2D learnedTiles;

vec4 columnAt(ivec2 p) {
    return vec4(texelFetch(columns, p, 0)) / (255.0 * float(kPassScale));
}

float learned() {
    ivec2 tile = ivec2(gl_FragCoord.xy * vec2(params.scaleX, params.scaleY)) >> 4;
    if (!(texelFetch(learnedTiles, min(tile, textureSize(learnedTiles, 0) - 1), 0).r > 0.0)) return 0.0;
    float x = float(kGrid) * gl_FragCoord.x * params.scaleX - 0.5;
    int y = int(gl_FragCoord.y), left = int(floor(x));
    ivec2 at = clamp(ivec2(left, left + 1), 0, kGrid * params.videoWidth - 1);
    int a = texelFetch(residuals, ivec2(at.x >> kGridShift, y), 0)[at.x & (kGrid - 1)];
    int b = texelFetch(residuals, ivec2(at.y >> kGridShift, y), 0)[at.y & (kGrid - 1)];
    return mix(float(a), float(b), x - floor(x)) / (255.0 * float(kPassScale));
}
