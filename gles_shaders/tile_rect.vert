// Draws one rectangle of six vertices per listed tile, at any resolution.
// In: position of the tile, packed by tiles.glsl (one per instance).
// PLAIN_TILE: also outputs the look-up (see look_up.glsl) at the tile's corners. Its value at a
// corner is the mean of the four cells that meet there.
// AROUND: on each side, the rectangle extends kTileAround video pixels beyond the tile, as far as
// the picture reaches.
// Variant: #define PLAIN_TILE
// Variant: #define AROUND
#include "tile_params.glsl"
#include "tiles.glsl"

layout(location = 0) in uint packedTile;
#ifdef PLAIN_TILE
layout(binding = 2) uniform sampler2D lookupField;
out vec4 plainLookUp;
#endif

void main() {
    ivec2 corner = ivec2(gl_VertexID % 3 == 1 || gl_VertexID == 3 ? 1 : 0,
                         gl_VertexID % 3 == 2 || gl_VertexID == 3 ? 1 : 0);
    ivec2 at = unpackTile(packedTile) + corner;
    ivec2 pixel = 16 * at;
#ifdef AROUND
    pixel += (2 * corner - 1) * kTileAround;
#endif
    vec2 p = vec2(clamp(pixel, ivec2(0), videoSize()));
#ifdef PLAIN_TILE
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i)
        sum += texelFetch(lookupField, clamp(4 * at - ivec2(i & 1, i >> 1), ivec2(0), cellCount() - 1), 0);
    plainLookUp = 0.25 * sum;
#endif
    gl_Position = vec4(2.0 * p / vec2(videoSize()) - 1.0, 0.0, 1.0);
}
