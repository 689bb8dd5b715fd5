// Computes the mean luma of the still over each video pixel, for learned filters; see kSeen.
// In: video, look-ups, luma of the still with amplified finest detail.
// Out: luma [1/64 grey level]; guidance signal [1/64 grey level], which is zero where the still is
// not trusted; 1 where the still is trusted, else 0.
#include "tile_params.glsl"
#include "still_seen.glsl"
#include "luma.glsl"
#include "pipeline/engine/params/enlarge.h"

layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out ivec4 seen;

void main() {
    vec2 means = stillMeans();
    float scale = 255.0 * float(kPassScale), shown = means.x + params.guidanceLight * (sqrt(means.y) - means.x);
    ivec2 p = ivec2(gl_FragCoord.xy);
    int trusted = texelFetch(lookupField, p >> 2, 0).z > 0.0 ? 1 : 0;
    float off = params.guidanceStill * shown - params.guidanceVideo * lumaOf(texelFetch(picture, p, 0).rgb);
    seen = ivec4(scale * shown + 0.5, trusted * int(floor(scale * off + 0.5)), trusted, 0);
}
