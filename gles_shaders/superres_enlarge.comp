// Computes the residual of the learned enlarger relative to Keys' cubic, for 4x4 sub-pixels per
// pixel. A pixel has two classes with a filter each; the result is the mean of both residuals,
// limited as kOvershoot describes. A residual is the weighted sum of the differences between the
// pixel's neighbours and the pixel.
// Computes only the tiles that are drawn with learned filters, and the pixels around these tiles.
// In: video, states of the tiles, filters of all classes. Out: residual image [1/32 grey level]. A
// pixel has four texels, one below the other, with a row of four sub-pixels each.
// Method: see pipeline/enlarge/filter_layout.h. One workgroup per upper or lower half of a tile.
#include "cubic.glsl"
#include "luma.glsl"
#include "pipeline/engine/params/enlarge.h"
#include "enlarge_classes.glsl"
#include "enlarge_filters.glsl"

const int kGroupWidth = 16, kGroupHeight = 8, kGroupSize = kGroupWidth * kGroupHeight;
const int kReach = 3;  // largest distance of a pixel that influences class or residual [px]
const int kPitch = kGroupWidth + 2 * kReach;
const int kLumas = kPitch * (kGroupHeight + 2 * kReach);
const int kSumPitch = kGroupWidth + 4;
const int kSums = kSumPitch * kGroupHeight;

layout(local_size_x = 16, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    EnlargeTiles params;
};
layout(std430, binding = 0) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];
};
layout(binding = 0) uniform sampler2D picture;
layout(rgba16i, binding = 0) uniform writeonly highp iimage2D residual;

shared float luma[kLumas];   // luma of the group and its surroundings [1/8 grey level]
shared float sumsXx[kSums];  // sums of gx * gx over five rows; (gx, gy): twice the gradient
shared float sumsXy[kSums];
shared float sumsYy[kSums];

bool learns(ivec2 tile) {
    if (any(lessThan(tile, ivec2(0))) || any(greaterThanEqual(tile, ivec2(params.columns, params.rows))))
        return false;
    uvec2 flags = tiles[tile.y * params.columns + tile.x];
    return (header.x != 0u || flags.x != 0u) && flags.y != 0u;
}

// True if learns() is true for any tile that contains or touches one of the pixels from `first` to
// `last`.
bool learnsAround(ivec2 first, ivec2 last) {
    ivec2 low = (first - 1) >> 4, high = (last + 1) >> 4;
    bool any = false;
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
            any = any || learns(ivec2(x, y));
    return any;
}

void loadLuma(ivec2 origin) {
    ivec2 last = ivec2(params.videoWidth, params.videoHeight) - 1;
    for (int i = int(gl_LocalInvocationIndex); i < kLumas; i += kGroupSize) {
        ivec2 p = origin - kReach + ivec2(i % kPitch, i / kPitch);
        float grey = 255.0 * lumaOf(texelFetch(picture, clamp(p, ivec2(0), last), 0).rgb);
        luma[i] = floor(float(kLumaScale) * grey + 0.5);
    }
}

void sumColumns() {
    for (int i = int(gl_LocalInvocationIndex); i < kSums; i += kGroupSize) {
        int at = (i / kSumPitch + 1) * kPitch + i % kSumPitch + 1;
        float above = luma[at - kPitch], here = luma[at];
        vec3 sums = vec3(0.0);
        for (int k = 0; k < 5; ++k) {
            float below = luma[at + kPitch];
            float gx = luma[at + 1] - luma[at - 1], gy = below - above;
            sums += vec3(gx * gx, gx * gy, gy * gy);
            above = here;
            here = below;
            at += kPitch;
        }
        sumsXx[i] = sums.x;
        sumsXy[i] = sums.y;
        sumsYy[i] = sums.z;
    }
}

vec4 rowFrom(int at) {
    return vec4(luma[at], luma[at + 1], luma[at + 2], luma[at + 3]);
}

float least(vec4 v) {
    return min(min(v.x, v.y), min(v.z, v.w));
}
float most(vec4 v) {
    return max(max(v.x, v.y), max(v.z, v.w));
}

vec3 sumsAround() {
    int i = int(gl_LocalInvocationID.y) * kSumPitch + int(gl_LocalInvocationID.x);
    vec3 sums = vec3(0.0);
    for (int k = 0; k < 5; ++k)
        sums += vec3(sumsXx[i + k], sumsXy[i + k], sumsYy[i + k]);
    return sums;
}

void enlarge(ivec2 pixel, int at) {
    float here = luma[at];
    int up = at - kPitch, down = at + kPitch;
    int gradient = gradientClass(sumsAround());
    vec4 above2 = rowFrom(up - kPitch - 2) - here, above = rowFrom(up - 2) - here;
    vec4 below = rowFrom(down - 2) - here, below2 = rowFrom(down + kPitch - 2) - here;
    vec4 beside = vec4(luma[at - 2], luma[at - 1], luma[at + 1], luma[at + 2]) - here;
    vec4 right = vec4(luma[up - kPitch + 2], luma[up + 2], luma[down + 2], luma[down + kPitch + 2]) - here;

    int curvature = curvatureClass(beside.y + beside.z, above.z + below.z, below.w + above.y - above.w - below.y);
    vec4 low = min(min(min(above2, above), min(below, below2)), min(beside, right));
    vec4 high = max(max(max(above2, above), max(below, below2)), max(beside, right));
    float lowest = min(least(low), 0.0), highest = max(most(high), 0.0);
    float more = floor(kOvershoot * (highest - lowest));
    float under = lowest - more, over = highest + more;

    uvec4 above4 = uvec4(halvesOf(above2), halvesOf(above)), below4 = uvec4(halvesOf(below), halvesOf(below2));
    uvec4 beside4 = uvec4(halvesOf(beside), halvesOf(right));
    ivec2 classes = ivec2(gradient, kGradientAngles * kGradientKinds + curvature);
    for (int row = 0; row < kGrid; ++row) {
        vec4 sum = residualOf(classes, row, above4, below4, beside4);
        vec4 cubic = cubicOf(row, above4, below4, beside4);
        vec4 limited = clamp(sum + cubic, vec4(under), vec4(over)) - cubic;
        imageStore(residual, ivec2(pixel.x, kGrid * pixel.y + row),
                   ivec4(floor(float(kResidualScale / kLumaScale) * limited + 0.5)));
    }
}

void main() {
    ivec2 group = ivec2(gl_WorkGroupID.xy) + ivec2(params.firstColumn, 2 * params.firstRow);
    ivec2 origin = group * ivec2(kGroupWidth, kGroupHeight);
    ivec2 local = ivec2(gl_LocalInvocationID.xy), pixel = origin + local;
    bool works = learnsAround(origin, origin + ivec2(kGroupWidth, kGroupHeight) - 1);
    if (works) loadLuma(origin);
    memoryBarrierShared();
    barrier();
    if (works) sumColumns();
    memoryBarrierShared();
    barrier();
    if (!works || pixel.x >= params.videoWidth || pixel.y >= params.videoHeight || !learnsAround(pixel, pixel)) return;
    enlarge(pixel, (local.y + kReach) * kPitch + local.x + kReach);
}
