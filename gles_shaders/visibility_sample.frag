// Computes the visibility [0, 1] of virtual pixels that visibility_decide.frag left undecided: the
// weighted mean over the 4x4 nearest samples of the real depth. Weights depend on the distance, and
// on the similarity of the video's colour at the sample to the picture's colour at the pixel. Depth
// edges therefore follow image edges (joint bilateral upsampling, Kopf et al. 2007).
// In: virtual z [m], inverse depth and sigma of the real scene [1/m], video, output picture. Out:
// visibility, R8.
#include "visibility.glsl"
#include "virtual_layer.glsl"

layout(binding = 0) uniform sampler2D virtualDepth;
layout(binding = 1) uniform sampler2D realDepth;
layout(binding = 2) uniform sampler2D videoPicture;
layout(binding = 3) uniform sampler2D picture;
layout(location = 0) out float visibility;

// Returns the share [0, 1] of a virtual surface that one sample of the real depth leaves visible.
// `inverse` is the inverse depth of the surface [1/m]. The result is 1 if the real depth is
// unknown.
float visibleOver(vec2 real, float inverse) {
    if (!known(real)) return 1.0;
    float sigma = max(length(vec2(real.y, params.virtualSigma * inverse)), 1e-9);
    return 1.0 - smoothstep(params.bias, params.bias + params.softness, (real.x - inverse) / sigma);
}

void main() {
    float z = layerDepth(virtualDepth);
    float inverse = 1.0 / (z > 0.0 ? z : 1.0);
    vec2 at = inVideo();
    ivec2 base = ivec2(floor(at));
    vec3 here = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 16; ++i) {
        ivec2 q = base + ivec2(i & 3, i >> 2) - 1;
        vec2 tent = 2.0 - abs(vec2(q) - at);
        q = clamp(q, ivec2(0), lastVideoPixel());
        vec3 unlike = texelFetch(videoPicture, q, 0).rgb - here;
        // If no sample has a similar colour, kLikenessFloor lets the distance determine the weight.
        float w = tent.x * tent.x * tent.y * tent.y *
                  (exp(-params.likeness * dot(unlike, unlike)) + kLikenessFloor);
        sum += w * visibleOver(texelFetch(realDepth, q, 0).rg, inverse);
        weights += w;
    }
    visibility = sum / weights;
}
