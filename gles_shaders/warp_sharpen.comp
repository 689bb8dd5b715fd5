// Blends individually rendered pixels over the warped picture while they fade in.
// In: list[] = for each pixel: row-major index, warped colour, rendered colour (RGBA8
// premultiplied). Out: colour of these pixels.
#include "warp_edge_params.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, rgba8) writeonly uniform image2D colour;
layout(std430, binding = 0) readonly buffer List {
    uvec4 list[];
};

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(params.shown)) return;
    uvec4 entry = list[i];
    ivec2 p = ivec2(int(entry.x) % params.width, int(entry.x) / params.width);
    imageStore(colour, p, mix(unpackUnorm4x8(entry.y), unpackUnorm4x8(entry.z), params.renderedShare));
}
