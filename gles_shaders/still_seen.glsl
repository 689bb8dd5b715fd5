// Computes the mean luma of the still over the area of a video pixel. Needs tile_params.glsl.
layout(binding = 2) uniform sampler2D lookupField;
layout(binding = 3) uniform sampler2D still;

vec2 inStill(vec2 p) {
    vec2 scale = vec2(params.stillScaleX, params.stillScaleY) / vec2(params.scaleX, params.scaleY);
    return (p * scale + textureLod(lookupField, p / vec2(4 * cellCount()), 0.0).xy) *
           vec2(params.stillTexelX, params.stillTexelY);
}

// Returns the mean of 4x4 samples of the still over this video pixel (x), and the mean of their
// squares (y). inStill() gives the positions of the four corner samples. The other positions are
// interpolated bilinearly between them.
vec2 stillMeans() {
    const float reach = 0.375 * kSeen;
    vec2 first = inStill(gl_FragCoord.xy - reach), last = inStill(gl_FragCoord.xy + reach);
    vec2 right = inStill(gl_FragCoord.xy + vec2(reach, -reach));
    vec2 below = inStill(gl_FragCoord.xy + vec2(-reach, reach));
    vec2 sums = vec2(0.0);
    for (int i = 0; i < 16; ++i) {
        vec2 share = vec2(i & 3, i >> 2) / 3.0;
        float value = textureLod(still, mix(mix(first, right, share.x), mix(below, last, share.x), share.y), 0.0).r;
        sums += vec2(value, value * value);
    }
    return sums / 16.0;
}
