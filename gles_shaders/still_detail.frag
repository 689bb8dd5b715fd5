// What the still shows beyond the video's resolution: luma less the upscaled still_low.frag.
// In: RGBA8 still, luma at the video's scale. Out: difference + 128 of 255, clamped.
#include "cubic.glsl"
#include "luma.glsl"

layout(std140, binding = 0) uniform Params {
    ivec4 low;   // width, height of the low picture, -, -
    vec4 scale;  // low pixels per still pixel (x, y), -, -
};
layout(binding = 0) uniform sampler2D still;
layout(binding = 1) uniform sampler2D lowPicture;
layout(location = 0) out vec4 detail;

float lowAt(ivec2 p) {
    return texelFetch(lowPicture, clamp(p, ivec2(0), low.xy - 1), 0).r;
}

void main() {
    vec2 p = gl_FragCoord.xy * scale.xy - 0.5;
    ivec2 i = ivec2(floor(p));
    vec4 wx = cubicWeights(p.x - floor(p.x)), wy = cubicWeights(p.y - floor(p.y));
    float up = 0.0;
    for (int r = 0; r < 4; ++r) {
        ivec2 q = i + ivec2(-1, r - 1);
        up += wy[r] * dot(wx, vec4(lowAt(q), lowAt(q + ivec2(1, 0)), lowAt(q + ivec2(2, 0)),
                                   lowAt(q + ivec2(3, 0))));
    }
    float value = lumaOf(texelFetch(still, ivec2(gl_FragCoord.xy), 0).rgb);
    detail = vec4(value - up + 128.0 / 255.0);
}
