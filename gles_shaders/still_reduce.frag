// Reduces the still along one axis by a tent filter. The tent is two pixels of the result wide.
// In: RGBA8. Out: RGBA8.
// Sharper kernels are worse, because they keep high frequencies, for which matches are least exact.
// Measured on photographs reduced from 2304 to 1067 pixels across: Keys' cubic is 0.2 to 1.3 dB
// worse than the tent, and Mitchell's filter is between the two.
// TAPS: largest number of pixels under the tent. It is a constant, so that the compiler can unroll
// the loop.
// Variant: #define TAPS 8
#ifndef TAPS
#define TAPS 3
#endif

#include "pipeline/engine/params/still.h"

layout(std140, binding = 0) uniform Params {
    ReduceStill params;
};
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 reduced;

void main() {
    ivec2 along = ivec2(params.alongX, params.alongY), last = textureSize(picture, 0) - 1;
    ivec2 across = ivec2(gl_FragCoord.xy) * (1 - along);
    float centre = dot(gl_FragCoord.xy, vec2(along)) * params.scale - 0.5;
    int first = int(ceil(centre - params.scale));
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < TAPS; ++i) {
        float weight = max(params.scale - abs(float(first + i) - centre), 0.0);
        weights += weight;
        sum += weight * texelFetch(picture, clamp(across + along * (first + i), ivec2(0), last), 0).rgb;
    }
    reduced = vec4(sum / weights, 1.0);
}
