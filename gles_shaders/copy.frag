// The same pixels in another texture of the same size.

#include "tile_params.glsl"
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 colour;

void main() {
    colour = texelFetch(picture, min(ivec2(gl_FragCoord.xy), video.xy - 1), 0);
}
