// Writes number and depth of the surface that is visible in this pixel.
// Out: R32UI, packed by warp_surface.glsl.
// Variant: #define ALPHA_MASK
#include "warp_silhouette_params.glsl"
#include "warp_surface.glsl"

#ifdef ALPHA_MASK
// Alpha times the material's alpha factor; the texture repeats.
layout(binding = 0) uniform sampler2D alpha;
in vec2 texel;
#endif
layout(location = 0) out uint surface;

void main() {
#ifdef ALPHA_MASK
    if (!(textureLod(alpha, texel, 0.0).r >= params.cutoff)) discard;
#endif
    surface = packSurface(1.0 / gl_FragCoord.w, uint(params.number));
}
