// Draws output pixels without detail of the still: the video, enlarged by Keys' cubic.
// LINEAR: enlarges by linear interpolation instead. LEARNED: adds the learned enlarger's residual
// to Keys' cubic.
// Variant: #define LINEAR
// Variant: #define LEARNED
#include "tile_params.glsl"
#ifdef LEARNED
#include "learned.glsl"
#else
#include "columns.glsl"
#endif
#include "enlarge.glsl"

layout(location = 0) out vec4 colour;

#ifdef LINEAR
vec3 enlargedLinearly() {
    float x = gl_FragCoord.x * params.scaleX - 0.5;
    int y = int(gl_FragCoord.y);
    int column = int(floor(x));
    return mix(texelFetch(columns, ivec2(max(column, 0), y), 0).rgb,
               texelFetch(columns, ivec2(min(column + 1, params.videoWidth - 1), y), 0).rgb, x - floor(x));
}
#endif

void main() {
#ifdef LINEAR
    colour = vec4(enlargedLinearly(), 1.0);
#elif defined(LEARNED)
    colour = vec4(enlarged().rgb + learned(), 1.0);
#else
    colour = vec4(enlarged().rgb, 1.0);
#endif
}
