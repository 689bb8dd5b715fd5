// Output where the still adds nothing: the upscaled video.
#include "tile_params.glsl"
#include "upscale.glsl"

layout(location = 0) out vec4 colour;

void main() {
    colour = vec4(upscaled(), 1.0);
}
