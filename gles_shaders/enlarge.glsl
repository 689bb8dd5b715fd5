// Second half of the bicubic enlargement: along rows. superres_vertical.frag is the first half; see
// there for the meaning of alpha. Needs tile_params.glsl, and columns.glsl or learned.glsl.
#include "cubic.glsl"

vec4 enlarged() {
    float x = gl_FragCoord.x * params.scaleX - 0.5;
    int y = int(gl_FragCoord.y);
    int column = int(floor(x));
    vec4 w = cubicWeights(x - floor(x));
    int last = params.videoWidth - 1;
    return w.x * columnAt(ivec2(clamp(column - 1, 0, last), y)) + w.y * columnAt(ivec2(clamp(column, 0, last), y)) +
           w.z * columnAt(ivec2(clamp(column + 1, 0, last), y)) + w.w * columnAt(ivec2(clamp(column + 2, 0, last), y));
}
