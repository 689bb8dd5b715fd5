// Computes the finest pyramid level of a picture of the video's size: its luma, smoothed over 3x3
// pixels. Text and fabric alias at the video's resolution. Without smoothing, the search would prefer
// displacements by whole pixels there.
// In: picture, RGBA8 or grey. Out: words of luma. One invocation per word, including margins.
#include "luma.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    LumaFromVideo params;
};
layout(binding = 0) uniform sampler2D picture;
layout(std430, binding = 0) writeonly buffer Luma {
    uint luma[];
};

float column(int x, int y) {
    ivec2 last = ivec2(params.target.width, params.target.height) - 1;
    float sum = 0.0;
    for (int i = -1; i <= 1; ++i) {
        ivec2 p = clamp(ivec2(x, y + i), ivec2(0), last);
        float weight = i == 0 ? 1.0 - 2.0 * params.smoothing : params.smoothing;
        sum += weight * lumaOf(texelFetch(picture, p, 0).rgb);
    }
    return sum;
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    LumaLevel target = params.target;
    if (at.x >= target.pitch || at.y >= target.height) return;
    int first = 4 * (at.x - kLumaMarginWords);
    int x = clamp(first, 0, 4 * ((target.width - 1) / 4));
    float columns[6];
    for (int i = 0; i < 6; ++i) columns[i] = column(x + i - 1, at.y);
    vec4 inside, v;
    for (int i = 0; i < 4; ++i)
        inside[i] = 255.0 * mix(columns[i + 1], 0.5 * (columns[i] + columns[i + 2]), 2.0 * params.smoothing);
    for (int i = 0; i < 4; ++i) v[i] = inside[clamp(first + i, 0, target.width - 1) - x];
    luma[target.offset + at.y * target.pitch + at.x] = packPixels(v);
}
