// A surface in one word: the upper 24 bits of z [m] (2^-16 of it), the number of what it belongs to.
const uint kCatcher = 255u;  // kCatcherId

uint packSurface(float z, uint id) {
    return ((floatBitsToUint(z) + 0x80u) & 0xffffff00u) | id;
}
float surfaceDepth(uint surface) {
    return uintBitsToFloat(surface & 0xffffff00u);
}
uint surfaceId(uint surface) {
    return surface & 0xffu;
}

// Of z, as shown: a shadow is so much nearer than what it lies on; kShadowLift of virtual_layer.h.
const float kShadowLift = 0.02;
const float kSameDepth = 0.003;  // of z: surfaces as close as that are one
