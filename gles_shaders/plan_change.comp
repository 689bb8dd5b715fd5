// What tells whether a tile of 16x16 pixels differs from the picture it was last drawn from.
// In: video now, video as last drawn. Out: two vec4 a tile: (1 when it surely changed or 0, standard
// deviation of the video's noise in grey levels, structure, -) and mean squares of the luma's difference,
// scaled so that all of white noise are its variance: of its pixels, of 2x2 means, of their twist. One
// invocation 4x4 pixels, 16 a tile.
// Surely changed: a cell's mean difference is beyond its noise, or its mean absolute difference, which shows
// fine structure that moved, or the tile's mean and slopes are, in units of the difference's own noise.
// Colour counts by its largest channel. What is too weak for one tile shows in many: that is left to
// plan_dispatch.comp.
// Structure is what of the luma's 2x2 means the plane through 8x8 pixels leaves: the sum of squares, mean of
// the tile's 9 places. A slope alone tells no match from another.
// A twist is (a - b - c + d) / 2 of 2x2 values, which is blind to slopes (after Immerkaer, Fast noise
// variance estimation, 1996).
// Range: measured 0..1.1e6
#include "luma.glsl"

layout(local_size_x = 16) in;
layout(std140, binding = 0) uniform Params {
    ivec4 size;        // video width, height, tiles a row, rows
    vec4 threshold;    // of a cell's mean and of its mean absolute difference [grey levels]; a 2x2 mean's
                       // noise variance in quarters of a pixel's
};
layout(binding = 0) uniform sampler2D now;
layout(binding = 1) uniform sampler2D drawn;
layout(std430, binding = 0) writeonly buffer Measured {
    vec4 measured[];
};

const float kMeanToDeviation = 1.2533;  // of the absolute value of a Gaussian
// Of mean and both slopes, each squared over its variance: 1e-8 of tiles at rest are beyond.
const float kSurely = 40.0;
// Of a cell's mean, likewise.
const float kCellSurely = 30.0;
const float kRounding = 0.17;  // variance of the difference of two pixels of 8 bits

shared uint flags[16];
shared float largest[16];  // of the channels' mean differences
shared float light[64];    // 2x2 means of the video's luma
shared float structure[16];
shared vec3 means[16];   // of red, luma, blue
shared vec3 twists[16];  // sums of squares over 4 blocks
shared vec3 sums[16];    // spatial twist, squares of 2x2 means, squared twist of those

// Mean and slopes of each channel's cells, squared, over their variance.
float momentsOf(vec3 variance) {
    vec3 sum = vec3(0.0), x = vec3(0.0), y = vec3(0.0);
    for (int i = 0; i < 16; ++i) {
        sum += means[i];
        x += (float(i & 3) - 1.5) * means[i];
        y += (float(i >> 2) - 1.5) * means[i];
    }
    vec3 z = (sum * sum / 16.0 + (x * x + y * y) / 20.0) / variance;
    return max(z.x, max(z.y, z.z));
}

// Of 4x4 values from `first` on.
float besidePlane(ivec2 first) {
    float sum = 0.0, squares = 0.0;
    vec2 slope = vec2(0.0);
    for (int i = 0; i < 16; ++i) {
        float v = light[(first.y + (i >> 2)) * 8 + first.x + (i & 3)] - light[first.y * 8 + first.x];
        sum += v;
        squares += v * v;
        slope += (vec2(i & 3, i >> 2) - 1.5) * v;
    }
    return max(squares - sum * sum / 16.0 - dot(slope, slope) / 20.0, 0.0);
}

void main() {
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    int part = int(gl_LocalInvocationID.x);
    ivec2 origin = 16 * tile + 4 * ivec2(part & 3, part >> 2);
    vec3 mean = vec3(0.0), absolute = vec3(0.0), twist2 = vec3(0.0);
    float rough = 0.0;
    vec4 quads = vec4(0.0);
    for (int b = 0; b < 4; ++b) {
        float rise = 0.0;
        float lit = 0.0;
        vec3 twist = vec3(0.0);
        for (int i = 0; i < 4; ++i) {
            ivec2 p = origin + 2 * ivec2(b & 1, b >> 1) + ivec2(i & 1, i >> 1);
            bool inside = all(lessThan(p, size.xy));
            p = min(p, size.xy - 1);
            vec3 v = 255.0 * texelFetch(now, p, 0).rgb;
            // Beyond the border there is none: repeated noise would look like a change.
            vec3 d = inside ? v - 255.0 * texelFetch(drawn, p, 0).rgb : vec3(0.0);
            float sign = i == 0 || i == 3 ? 0.5 : -0.5;
            mean += d;
            absolute += abs(d);
            rise += sign * lumaOf(v);
            lit += 0.25 * lumaOf(v);
            twist += sign * vec3(d.r, lumaOf(d), d.b);
            quads[b] += 0.25 * lumaOf(d);
        }
        rough += abs(rise);
        light[8 * (2 * (part >> 2) + (b >> 1)) + 2 * (part & 3) + (b & 1)] = lit;
        twist2 += twist * twist;
    }
    mean /= 16.0;
    absolute /= 16.0;
    float a = max(absolute.x, max(absolute.y, absolute.z));
    flags[part] = a <= threshold.y ? 0u : 1u;
    largest[part] = max(abs(mean.x), max(abs(mean.y), abs(mean.z)));
    means[part] = vec3(mean.r, lumaOf(mean), mean.b);
    twists[part] = twist2;
    float bent = 0.5 * (quads.x - quads.y - quads.z + quads.w);
    sums[part] = vec3(rough, dot(quads, quads), bent * bent);
    barrier();
    structure[part] = part < 9 ? besidePlane(2 * ivec2(part % 3, part / 3)) : 0.0;
    barrier();
    if (part != 0) return;
    uint changed = 0u;
    vec3 variance = vec3(0.0), sum = vec3(0.0);
    float most = 0.0, structured = 0.0;
    for (int i = 0; i < 16; ++i) {
        changed |= flags[i];
        most = max(most, largest[i]);
        structured += structure[i] / 9.0;
        variance += twists[i] / 64.0;
        sum += sums[i];
    }
    vec3 ofCell = (variance + kRounding) / 16.0 * threshold.z;
    float noisiest = kCellSurely * max(ofCell.x, max(ofCell.y, ofCell.z));
    if (most > threshold.x && most * most > noisiest) changed = 1u;
    if (!(momentsOf(ofCell) <= kSurely)) changed = 1u;
    int at = 2 * (tile.y * size.z + tile.x);
    measured[at] = vec4(float(changed), sum.x * kMeanToDeviation / 64.0, structured, 0.0);
    measured[at + 1] = vec4(variance.y, sum.y / 16.0, sum.z / 4.0, 0.0);
}
