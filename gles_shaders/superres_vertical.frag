// Upscaling, first half: columns of four channels. In: prefiltered video. Out: video width x output height.
// Variant: #define LINEAR
#include "cubic.glsl"

#include "tile_params.glsl"
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 colour;

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
        sum += w[i] * texelFetch(picture, ivec2(x, clamp(row + i - 1, 0, params.videoHeight - 1)), 0);
    colour = sum;
}
