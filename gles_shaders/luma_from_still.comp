// Computes the finest pyramid level of the still, in the geometry and resolution of the video. The
// tone curve is applied to the still's luma. Each video pixel gets the mean of this luma over a
// square that is wider than the pixel (params.footprint); see kSeen for the kind of mean.
// In: still, RGBA8; tone curve. Out: words of luma. One invocation per word.
#include "luma.glsl"
#include "rig.glsl"
#include "still_tone.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    LumaFromStill params;
};
layout(binding = 0) uniform sampler2D still;
layout(std430, binding = 0) writeonly buffer Luma {
    uint luma[];
};

float footprintMean(vec2 centre) {
    vec2 texel = vec2(params.texelX, params.texelY);
    vec2 sums = vec2(0.0);  // of the samples, of their squares
    for (int j = 0; j < kFootprintTaps; ++j) {
        for (int i = 0; i < kFootprintTaps; ++i) {
            vec2 off = (vec2(i, j) + 0.5) / float(kFootprintTaps) - 0.5;
            vec2 q = centre + off * params.footprint;
            float value = toned(lumaOf(textureLod(still, (q + 0.5) * texel, 0.0).rgb));
            sums += vec2(value, value * value);
        }
    }
    vec2 means = sums / float(kFootprintTaps * kFootprintTaps);
    return 255.0 * mix(means.x, sqrt(means.y), params.light);
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    LumaLevel target = params.target;
    if (at.x >= target.pitch || at.y >= target.height) return;
    vec4 v;
    for (int i = 0; i < 4; ++i) {
        int x = clamp(4 * (at.x - kLumaMarginWords) + i, 0, target.width - 1);
        v[i] = footprintMean(stillPixel(params.rig, vec2(x, at.y)));
    }
    luma[target.offset + at.y * target.pitch + at.x] = packPixels(v);
}
