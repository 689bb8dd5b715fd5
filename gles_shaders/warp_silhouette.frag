// Writes number, depth and paint of the surface that is visible in this pixel.
// Out: R32UI, packed by warp_surface.glsl; paint (see base/paint_words.h), linear, into textures
// with sRGB encoding.
// Variant: #define ALPHA_MASK
#include "warp_silhouette_params.glsl"
#include "warp_surface.glsl"

layout(binding = 0) uniform sampler2D diffuseTexture;
layout(binding = 1) uniform sampler2D facingTexture;
#ifdef ALPHA_MASK
// Alpha of the material's texture, which repeats. `cutoff` is already divided by the alpha factor.
layout(binding = 2) uniform sampler2D alpha;
#endif
in vec2 texel;
// Added to the mipmap level, to make the paint sharper. This causes no aliasing, because a pixel
// of the layer shows the mean of four pixels of this pass.
const float kSharper = -0.5;
layout(location = 0) out uint surface;
layout(location = 1) out vec4 diffuse;
layout(location = 2) out vec4 facing;

void main() {
    diffuse = texture(diffuseTexture, texel, kSharper);
    facing = texture(facingTexture, texel, kSharper);
#ifdef ALPHA_MASK
    if (!(textureLod(alpha, texel, 0.0).r >= params.cutoff)) discard;
#endif
    surface = packSurface(1.0 / gl_FragCoord.w, uint(params.number));
}
