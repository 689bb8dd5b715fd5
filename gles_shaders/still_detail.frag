// What the still shows beyond the video's resolution: luma less the upscaled still_low.frag.
// In: RGBA8 still, luma at the video's scale. Out: difference + 128 of 255, clamped.
#include "cubic.glsl"
#include "luma.glsl"
#include "pipeline/engine/params/still.h"

layout(std140, binding = 0) uniform Params {
    StillDetail params;
};
layout(binding = 0) uniform sampler2D still;
layout(binding = 1) uniform sampler2D lowPicture;
layout(location = 0) out vec4 detail;

// The neighbours' share makes up for what the linear filter, with which composite_detail.frag reads, takes
// from high frequencies. Over all places between pixels and beyond the video's frequencies least squares give
// 0.11 for the power of natural pictures (f^-2 to f^-3); less is better, as what is matched a little beside
// its place gets worse (measured: 0.08 gives +0.5 dB on synthetic scenes, -0.1 dB on photographs, and half of
// what sharpness, LPC-SI, lacked). None on a still that was reduced, whose highest frequencies are not weak
// (+2.5 dB on a photograph at 1067 of 2304 pixels across).
vec3 stillAt(ivec2 p) {
    return texelFetch(still, clamp(p, ivec2(0), textureSize(still, 0) - 1), 0).rgb;
}

float lowAt(ivec2 p) {
    return texelFetch(lowPicture, clamp(p, ivec2(0), ivec2(params.lowWidth, params.lowHeight) - 1), 0).r;
}

void main() {
    vec2 p = gl_FragCoord.xy * vec2(params.scaleX, params.scaleY) - 0.5;
    ivec2 i = ivec2(floor(p));
    vec4 wx = cubicWeights(p.x - floor(p.x)), wy = cubicWeights(p.y - floor(p.y));
    float up = 0.0;
    for (int r = 0; r < 4; ++r) {
        ivec2 q = i + ivec2(-1, r - 1);
        up += wy[r] * dot(wx, vec4(lowAt(q), lowAt(q + ivec2(1, 0)), lowAt(q + ivec2(2, 0)),
                                   lowAt(q + ivec2(3, 0))));
    }
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 beside = stillAt(at - ivec2(1, 0)) + stillAt(at + ivec2(1, 0)) + stillAt(at - ivec2(0, 1)) +
                  stillAt(at + ivec2(0, 1));
    float value = lumaOf((1.0 + 4.0 * params.neighbours) * stillAt(at) - params.neighbours * beside);
    detail = vec4(value - up + 128.0 / 255.0);
}
