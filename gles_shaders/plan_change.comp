// Which tiles of 16x16 pixels differ from the picture they were last drawn from.
// In: video now, video as last drawn. Out: per tile, changed = 1 or 0, and the standard deviation of its
// noise in 1/256 grey levels: the mean of (a - b - c + d) / 2 over 2x2 blocks, which is blind to slopes
// (after Immerkaer, Fast noise variance estimation, 1996). One invocation 4x4 pixels, 16 a tile.
// A cell's mean difference shows slow changes below the noise of a pixel; its mean absolute difference
// shows fine structure that moved. Colour counts by its largest channel.
// Range: tiles 0..1, 0..1e6
#include "luma.glsl"

layout(local_size_x = 16) in;
layout(std140, binding = 0) uniform Params {
    ivec4 size;        // video width, height, tiles a row, rows
    vec4 threshold;    // of a cell's mean and of its mean absolute difference [grey levels]
    ivec4 force;       // x != 0: every tile counts as changed
};
layout(binding = 0) uniform sampler2D now;
layout(binding = 1) uniform sampler2D drawn;
layout(std430, binding = 0) writeonly buffer Tiles {
    uvec2 header;   // of plan_dispatch.comp
    uvec2 tiles[];  // changed, noise
};

const float kMeanToDeviation = 1.2533;  // of the absolute value of a Gaussian

shared float sums[16];
shared uint flags[16];

void main() {
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    int part = int(gl_LocalInvocationID.x);
    ivec2 origin = 16 * tile + 4 * ivec2(part & 3, part >> 2);
    vec3 mean = vec3(0.0), absolute = vec3(0.0);
    float rough = 0.0;
    for (int b = 0; b < 4; ++b) {
        float twist = 0.0;
        for (int i = 0; i < 4; ++i) {
            ivec2 p = origin + 2 * ivec2(b & 1, b >> 1) + ivec2(i & 1, i >> 1);
            p = min(p, size.xy - 1);
            vec3 v = texelFetch(now, p, 0).rgb;
            vec3 d = v - texelFetch(drawn, p, 0).rgb;
            mean += d;
            absolute += abs(d);
            twist += (i == 0 || i == 3 ? 0.5 : -0.5) * lumaOf(v);
        }
        rough += abs(twist);
    }
    mean = abs(mean) * (255.0 / 16.0);
    absolute *= 255.0 / 16.0;
    float m = max(mean.x, max(mean.y, mean.z)), a = max(absolute.x, max(absolute.y, absolute.z));
    bool same = m <= threshold.x && a <= threshold.y;
    flags[part] = same ? 0u : 1u;
    sums[part] = rough;
    barrier();
    if (part != 0) return;
    uint changed = force.x != 0 ? 1u : 0u;
    float sum = 0.0;
    for (int i = 0; i < 16; ++i) {
        changed |= flags[i];
        sum += sums[i];
    }
    tiles[tile.y * size.z + tile.x] = uvec2(changed, uint(clamp(sum * kMeanToDeviation * 255.0 / 64.0 * 256.0, 0.0, 1e6)));
}
