// Converts a picture from Y U V to R G B. Chroma has a lower resolution and is interpolated; a
// chroma sample is in the middle of the pixels that share it.
// In: planes of 8 bits (luma is read at its texel, chroma with a bilinear filter). Out: RGBA8,
// alpha 1.
// Source: ITU-R BT.601-7, BT.709-6; matrix rows of base/image_layout.h.
// Variant: #define PACKED 1 Y U Y V of two pixels in one texel
// Variant: #define PAIRS 1 a plane of Y, a plane of U V
#include "pipeline/gles/yuv_params.h"

layout(std140, binding = 0) uniform Params {
    YuvPicture params;
};
layout(binding = 0) uniform sampler2D first;
#ifndef PACKED
layout(binding = 1) uniform sampler2D second;
#ifndef PAIRS
layout(binding = 2) uniform sampler2D third;
#endif
#endif
layout(location = 0) out vec4 colour;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec2 at = gl_FragCoord.xy * vec2(params.texelX, params.texelY);
    vec4 yuv = vec4(1.0);
#ifdef PACKED
    vec4 texel = texelFetch(first, ivec2(p.x >> 1, p.y), 0);
    yuv.x = (p.x & 1) == 0 ? texel.r : texel.b;
    yuv.yz = textureLod(first, at, 0.0).ga;
#else
    yuv.x = texelFetch(first, p, 0).r;
#ifdef PAIRS
    yuv.yz = textureLod(second, at, 0.0).rg;
#else
    yuv.yz = vec2(textureLod(second, at, 0.0).r, textureLod(third, at, 0.0).r);
#endif
#endif
    colour.a = 1.0;
    for (int i = 0; i < 3; ++i)
        colour[i] = dot(vec4(params.rows[i].x, params.rows[i].y, params.rows[i].z, params.rows[i].w), yuv);
}
