// Packs a surface into one word: the upper 24 bits are those of z as a float [m] (relative
// precision 2^-16), and the lower 8 bits are the surface's number (of an object or the catcher).
#include "pipeline/warp/pass_params.h"

const uint kCatcher = kCatcherNumber;

uint packSurface(float z, uint id) {
    return ((floatBitsToUint(z) + 0x80u) & 0xffffff00u) | id;
}
float surfaceDepth(uint surface) {
    return uintBitsToFloat(surface & 0xffffff00u);
}
uint surfaceId(uint surface) {
    return surface & 0xffu;
}
// True unless all bytes of a premultiplied colour are 0. The light of a glowing object on a real
// surface has a colour, but no alpha.
bool isShown(vec4 colour) {
    return any(greaterThan(colour, vec4(0.5 / 255.0)));
}
