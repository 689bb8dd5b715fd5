// The tone curve that is applied to the still's luma, see StillTone.
layout(binding = 1) uniform sampler2D tone;  // 256 levels in one row, R8, linear filter

// `grey` is in [0, 1]; values outside are clamped.
float toned(float grey) {
    return textureLod(tone, vec2((255.0 * grey + 0.5) / 256.0, 0.5), 0.0).r;
}
