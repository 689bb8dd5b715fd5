// Parameters of the shaders that decide which virtual pixels are occluded, and the test for valid
// depth samples.
#include "pipeline/engine/params/occlusion.h"

layout(std140, binding = 0) uniform Params {
    Visibility params;
};

ivec2 lastVideoPixel() {
    return ivec2(params.videoWidth, params.videoHeight) - 1;
}
ivec2 outputSize() {
    return ivec2(params.outputWidth, params.outputHeight);
}
// Returns the position of the fragment in the video; pixel centres are at integers.
vec2 inVideo() {
    return gl_FragCoord.xy * vec2(params.scaleX, params.scaleY) - 0.5;
}

// True if a sample of the real scene's depth (inverse depth [1/m], sigma [1/m]) is valid, see
// kLeastInverseDepth. False for NaN.
bool known(vec2 real) {
    return real.x > kLeastInverseDepth && real.x < kMostInverseDepth && real.y > kLeastDepthSigma &&
           real.y < kMostInverseDepth;
}
