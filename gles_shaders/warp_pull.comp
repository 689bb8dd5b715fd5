// Computes a level of the push-pull pyramid from the next finer level. FIRST_LEVEL: computes the
// first level from the picture.
// In: colour and state of warp_rest.comp. Out: texels[].
// Variant: #define FIRST_LEVEL
#include "warp_hole_params.glsl"
#include "warp_pyramid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
#ifdef FIRST_LEVEL
layout(binding = 0) uniform sampler2D colour;
layout(binding = 1) uniform sampler2D state;
#endif
layout(std430, binding = 0) buffer Pyramid {
    uvec4 texels[];
};

uvec4 below(ivec2 p) {
    const uvec4 none = uvec4(0u);
#ifdef FIRST_LEVEL
    if (any(lessThan(p, firstPixel())) || any(greaterThanEqual(p, endPixel()))) return none;
    uint id = uint(texelFetch(state, p, 0).a * 255.0 + 0.5);
    if (id == 0u) return none;
    vec4 c = texelFetch(colour, p, 0);
    bool isCatcher = id == kCatcherNumber;
    return packArea(isCatcher ? Area(vec4(0.0), c, 0u, vec2(0.0, 1.0)) : Area(c, vec4(0.0), id, vec2(1.0, 0.0)));
#else
    HoleLevel level = params.levels[params.level - 2];
    ivec2 q = p - originOf(level);
    if (any(lessThan(q, ivec2(0))) || q.x >= level.columns || q.y >= params.rowsBelow) return none;
    return texels[level.first + q.y * level.columns + q.x];
#endif
}

void main() {
    HoleLevel level = params.levels[params.level - 1];
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= level.columns || p.y >= params.rows) return;
    uvec4 parts[4];
    for (int i = 0; i < 4; ++i) parts[i] = below(2 * (p + originOf(level)) + ivec2(i & 1, i >> 1));
    texels[level.first + p.y * level.columns + p.x] = packArea(merged(parts));
}
