// Bicubic upscaling, first half: columns. In: prefiltered video. Out: video width x output height.
#include "cubic.glsl"

#include "tile_params.glsl"
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 colour;

void main() {
    float y = gl_FragCoord.y * scale.y - 0.5;
    int x = int(gl_FragCoord.x);
    int row = int(floor(y));
    vec4 w = cubicWeights(y - floor(y));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i)
        sum += w[i] * texelFetch(picture, ivec2(x, clamp(row + i - 1, 0, video.y - 1)), 0).rgb;
    colour = vec4(sum, 1.0);
}
