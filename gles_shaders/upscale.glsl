// Bicubic upscaling, second half: rows; alpha as superres_sharpen.frag has it. Needs tile_params.glsl.
#include "cubic.glsl"

layout(binding = 0) uniform sampler2D columns;

vec4 upscaled() {
    float x = gl_FragCoord.x * params.scaleX - 0.5;
    int y = int(gl_FragCoord.y);
    int column = int(floor(x));
    vec4 w = cubicWeights(x - floor(x));
    int last = params.videoWidth - 1;
    return w.x * texelFetch(columns, ivec2(clamp(column - 1, 0, last), y), 0) +
           w.y * texelFetch(columns, ivec2(clamp(column, 0, last), y), 0) +
           w.z * texelFetch(columns, ivec2(clamp(column + 1, 0, last), y), 0) +
           w.w * texelFetch(columns, ivec2(clamp(column + 2, 0, last), y), 0);
}
