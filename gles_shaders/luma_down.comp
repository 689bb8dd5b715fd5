// Computes the next coarser pyramid level. Each of its pixels is the mean of 2x2 pixels. One
// invocation per word of four pixels, including margins.
#include "luma.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    LumaDown params;
};
layout(std430, binding = 0) buffer Luma {
    uint luma[];
};

float pixel(int x, int y) {
    LumaLevel fine = params.fine;
    x = clamp(x, 0, fine.width - 1);
    y = clamp(y, 0, fine.height - 1);
    uint word = luma[fine.offset + y * fine.pitch + (x >> 2) + kLumaMarginWords];
    return float((word >> uint(8 * (x & 3))) & 255u);
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    LumaLevel coarse = params.coarse;
    if (at.x >= coarse.pitch || at.y >= coarse.height) return;
    vec4 v;
    for (int i = 0; i < 4; ++i) {
        int x = 2 * clamp(4 * (at.x - kLumaMarginWords) + i, 0, coarse.width - 1);
        int y = 2 * at.y;
        v[i] = 0.25 * (pixel(x, y) + pixel(x + 1, y) + pixel(x, y + 1) + pixel(x + 1, y + 1));
    }
    luma[coarse.offset + at.y * coarse.pitch + at.x] = packPixels(v);
}
