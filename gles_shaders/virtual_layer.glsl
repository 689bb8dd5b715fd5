// Reads the layer of virtual objects at an output pixel. Needs visibility.glsl.
// SCALED_LAYER: the layer's size differs from the output's. Colours are interpolated linearly. The
// depth is copied from one of the four surrounding layer pixels: of those with a valid depth, the
// one closest to the output pixel.
// Variant: #define SCALED_LAYER 1

bool isVirtual(float z) {
    return z > kLeastVirtualDepth && z < kMostVirtualDepth;
}

#ifdef SCALED_LAYER
vec2 layerAt(out ivec2 base) {
    vec2 at = gl_FragCoord.xy * vec2(params.layerScaleX, params.layerScaleY) - 0.5;
    base = ivec2(floor(at));
    return at - vec2(base);
}
#endif

vec4 layerColour(highp sampler2D colours) {
#ifdef SCALED_LAYER
    return textureLod(colours, gl_FragCoord.xy / vec2(outputSize()), 0.0);
#else
    return texelFetch(colours, min(ivec2(gl_FragCoord.xy), outputSize() - 1), 0);
#endif
}

float layerDepth(highp sampler2D depths) {
#ifdef SCALED_LAYER
    ivec2 base;
    vec2 f = layerAt(base);
    vec4 z = textureGather(depths, vec2(base + 1) / vec2(params.layerWidth, params.layerHeight));
    vec4 left = vec4(1.0 - f.x, f.x, f.x, 1.0 - f.x), w = left * vec4(f.y, f.y, 1.0 - f.y, 1.0 - f.y);
    // textureGather returns the texels (0, 1), (1, 1), (1, 0), (0, 0).
    float best = 0.0, depth = 0.0;
    for (int i = 0; i < 4; ++i) {
        bool better = w[i] > best && isVirtual(z[i]);
        best = better ? w[i] : best;
        depth = better ? z[i] : depth;
    }
    return depth;
#else
    float z = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r;
    return isVirtual(z) ? z : 0.0;
#endif
}
