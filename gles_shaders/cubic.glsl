// Keys' cubic interpolation: weights of the four samples around a position. t is the distance of
// the position from the second sample, in sample spacings.
#include "pipeline/engine/params/detail.h"

vec4 cubicWeights(float t) {
    const float a = kCubicSlope;
    float s = 1.0 - t;
    float w0 = a * t * s * s;
    float w3 = a * s * t * t;
    float w1 = ((a + 2.0) * t - (a + 3.0)) * t * t + 1.0;
    return vec4(w0, w1, 1.0 - w0 - w1 - w3, w3);
}
