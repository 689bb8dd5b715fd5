// Looks up this output pixel in the still. Position and weight are interpolated between the cells.
// PLAIN_TILE: the tile is drawn as one rectangle, and they are interpolated between its corners.
// Needs tile_params.glsl.
#ifdef PLAIN_TILE
in vec4 plainLookUp;
#else
#include "look_up_cells.glsl"
layout(binding = 2) uniform sampler2D lookupField;
#endif

// Returns a LookUpCell: offset (x, y) [still px], weight of the detail, and confidence (eq. 2 of
// the paper). `uv` becomes the position in the still, in texture coordinates.
vec4 lookUp(out vec2 uv) {
#ifdef PLAIN_TILE
    vec4 l = plainLookUp;
#else
    vec4 l = lookUpCells(lookupField, gl_FragCoord.xy * vec2(params.scaleX, params.scaleY), cellCount());
#endif
    uv = (gl_FragCoord.xy * vec2(params.stillScaleX, params.stillScaleY) + l.xy) *
         vec2(params.stillTexelX, params.stillTexelY);
    return l;
}
