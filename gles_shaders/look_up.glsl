// Position of this output pixel in the still, and the still's weight there. Needs tile_params.glsl.
// In a plain tile the look-up is one linear function over the tile. In other tiles it is
// interpolated in the field of cells.
#ifdef PLAIN_TILE
in vec4 plainLookUp;
#else
layout(binding = 2) uniform sampler2D lookupField;
#endif

// Returns offset (x, y) [still px], weight of the detail, confidence (eq. 2).
vec4 lookUp(out vec2 uv) {
#ifdef PLAIN_TILE
    vec4 l = plainLookUp;
#else
    vec4 l = textureLod(lookupField, gl_FragCoord.xy * vec2(params.scaleX, params.scaleY) / vec2(4 * cellCount()), 0.0);
#endif
    uv = (gl_FragCoord.xy * vec2(params.stillScaleX, params.stillScaleY) + l.xy) *
         vec2(params.stillTexelX, params.stillTexelY);
    return l;
}
