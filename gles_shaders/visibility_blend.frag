// Multiplies the virtual layer by its visibility. The result is blended over the picture.
// In: layer, RGBA8 premultiplied by coverage; visibility, R8. Out: their product, premultiplied.
#include "visibility.glsl"
#include "virtual_layer.glsl"

layout(binding = 0) uniform sampler2D virtualColour;
layout(binding = 1) uniform sampler2D visibility;
layout(location = 0) out vec4 colour;

void main() {
    ivec2 p = min(ivec2(gl_FragCoord.xy), outputSize() - 1);
    colour = texelFetch(visibility, p, 0).r * layerColour(virtualColour);
}
