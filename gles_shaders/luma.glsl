// Luma pyramids in one storage buffer. A word has four 8-bit pixels, the leftmost in the low byte.
// Each row has a margin of kLumaMarginWords words at both ends that repeats the outermost pixel.
#include "pipeline/engine/params/luma.h"

vec4 unpackPixels(uint word) {
    return vec4(uvec4(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24));
}

uint packPixels(vec4 v) {
    uvec4 b = uvec4(clamp(v + 0.5, 0.0, 255.0));
    return b.x | (b.y << 8) | (b.z << 16) | (b.w << 24);
}

float lumaOf(vec3 rgb) {
    return dot(rgb, vec3(kLumaRed, kLumaGreen, kLumaBlue));
}
