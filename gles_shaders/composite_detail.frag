// out = up(video) + weight * (still - up(its mean over each video pixel)) (design: mode `detail`).
// With LEARNED also what the learned enlarger adds, by the share that the weight leaves of one: the still knows
// better what it shows.
// Variant: #define PLAIN_TILE
// Variant: #define LEARNED
#include "tile_params.glsl"
#include "look_up.glsl"
#ifdef LEARNED
#include "learned.glsl"
#include "still_linear.glsl"
#else
#include "columns.glsl"
#endif
#include "upscale.glsl"

layout(binding = 1) uniform sampler2D still;  // raised luma
layout(location = 0) out vec4 colour;

void main() {
    vec2 uv;
    vec4 l = lookUp(uv);
    vec4 video = upscaled();
#ifdef LEARNED
    float added = (1.0 - min(l.z, 1.0)) * learned() + l.z * (linearly(still, uv) - video.a);
#else
    float added = l.z * (textureLod(still, uv, 0.0).r - video.a);
#endif
    colour = vec4(video.rgb + added, 1.0);
}
