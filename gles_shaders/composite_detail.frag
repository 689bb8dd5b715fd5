// out = up(video) + weight * detail of the still (design: mode `detail`).
// Variant: #define PLAIN_TILE
#include "tile_params.glsl"
#include "look_up.glsl"
#include "upscale.glsl"

layout(binding = 1) uniform sampler2D detail;  // luma detail + 128 of 255
layout(location = 0) out vec4 colour;

void main() {
    vec2 uv;
    vec4 l = lookUp(uv);
    float d = textureLod(detail, uv, 0.0).r - 128.0 / 255.0;
    colour = vec4(upscaled() + l.z * d, 1.0);
}
