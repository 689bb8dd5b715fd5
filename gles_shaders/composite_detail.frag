// out = up(video) + weight * (still - up(its mean over each video pixel)) (design: mode `detail`).
// Variant: #define PLAIN_TILE
#include "tile_params.glsl"
#include "look_up.glsl"
#include "upscale.glsl"

layout(binding = 1) uniform sampler2D still;  // raised luma
layout(location = 0) out vec4 colour;

void main() {
    vec2 uv;
    vec4 l = lookUp(uv);
    vec4 video = upscaled();
    colour = vec4(video.rgb + l.z * (textureLod(still, uv, 0.0).r - video.a), 1.0);
}
