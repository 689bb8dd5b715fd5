// Mode Detail: out = up(video) + weight * (still - up(mean of the still over each video pixel)),
// where up() enlarges to the output's size.
// LEARNED: also adds the learned enlarger's residual times max(1 - weight, 0). Where the weight is
// large, the still is the better source of detail.
// SECOND (includes LEARNED): the picture already contains the first still's detail. `out` is
// computed with the second still and blended over the picture. The opacity rises with the
// difference between the second still's weight and the first still's weight; see kSecondFrom.
// Variant: #define PLAIN_TILE
// Variant: #define LEARNED
// Variant: #define SECOND
#ifdef SECOND
#define LEARNED
#endif
#include "tile_params.glsl"
#include "look_up.glsl"
#ifdef LEARNED
#include "learned.glsl"
#include "still_linear.glsl"
#else
#include "columns.glsl"
#endif
#include "enlarge.glsl"

layout(binding = 1) uniform sampler2D still;
#ifdef SECOND
#include "look_up_cells.glsl"
layout(binding = 5) uniform sampler2D newestField;

// Returns the weight that the first still has at this pixel.
float newestShare() {
    return lookUpCells(newestField, gl_FragCoord.xy * vec2(params.scaleX, params.scaleY), cellCount()).z;
}
#endif
layout(location = 0) out vec4 colour;

void main() {
    vec2 uv;
    vec4 l = lookUp(uv);
    vec4 video = enlarged();
#ifdef LEARNED
    float added = (1.0 - min(l.z, 1.0)) * learned() + l.z * (linearly(still, uv) - video.a);
#else
    float added = l.z * (textureLod(still, uv, 0.0).r - video.a);
#endif
#ifdef SECOND
    float shown = clamp((l.z - newestShare() - kSecondFrom) / (kSecondAlone - kSecondFrom), 0.0, 1.0);
    colour = shown * vec4(clamp(video.rgb + added, 0.0, 1.0), 1.0);
#else
    colour = vec4(video.rgb + added, 1.0);
#endif
}
