// The still at the video's scale, on its own pixel grid: mean over the footprint of a video pixel, which
// its optics make a quarter wider than its pitch (measured: +0.07 dB on photographs, +0.4 dB on synthetic
// scenes against the bare pitch). In: RGBA8 still. Out: luma, 8 bits.
#include "luma.glsl"

layout(std140, binding = 0) uniform Params {
    vec4 step;  // 1 / low size, distance of the 4x4 taps
};
layout(binding = 0) uniform sampler2D still;
layout(location = 0) out vec4 low;

void main() {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 16; ++i) {
        vec2 off = vec2(i & 3, i >> 2) - 1.5;
        sum += textureLod(still, gl_FragCoord.xy * step.xy + off * step.zw, 0.0).rgb;
    }
    low = vec4(lumaOf(sum / 16.0));
}
