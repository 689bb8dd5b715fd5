// Mode Blend, the method of the paper in docs/paper.md: blends the enlarged video with the warped
// still. The weight of the still is the confidence of the match (eq. 2).
// Variant: #define PLAIN_TILE
#include "tile_params.glsl"
#include "look_up.glsl"
#include "columns.glsl"
#include "enlarge.glsl"

layout(binding = 1) uniform sampler2D still;
layout(location = 0) out vec4 colour;

void main() {
    vec2 uv;
    vec4 l = lookUp(uv);
    colour = vec4(mix(enlarged().rgb, textureLod(still, uv, 0.0).rgb, l.w), 1.0);
}
