// Luma pyramids in one storage buffer. A word holds four 8-bit pixels, the leftmost in the low
// byte. Each row has a margin of kLumaMarginWords words at either end. The margin repeats the row's
// outermost pixel.
#include "pipeline/engine/params/luma.h"

vec4 unpackPixels(uint word) {
    return vec4(uvec4(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24));
}

// Rounds four values in [0, 255] and packs them.
uint packPixels(vec4 v) {
    uvec4 b = uvec4(clamp(v + 0.5, 0.0, 255.0));
    return b.x | (b.y << 8) | (b.z << 16) | (b.w << 24);
}

// Rec. 601 luma of an RGB colour.
float lumaOf(vec3 rgb) {
    return dot(rgb, vec3(kLumaRed, kLumaGreen, kLumaBlue));
}
