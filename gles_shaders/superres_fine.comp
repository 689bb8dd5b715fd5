// Compares the finest detail of video and still in each cell; see kFineRoom. The finest detail is
// the difference between a pixel and the mean of its 2x2 block.
// In: states of the tiles, look-ups, luma of the still with amplified finest detail, video.
// Out: means of three products over the middle two rows of the cell [grey levels^2]: video * video,
// video * still and still * still, each of finest detail. The means are zero in tiles that are not
// matched and in cells that are only partly inside the frame.
// One workgroup per tile, one invocation per cell. Only every kFineStep-th row of cells is sampled.
// Range: fineField 0..65025, -65025..65025, 0..65025, 0
#include "luma.glsl"
#include "still_linear.glsl"
#include "pipeline/engine/params/weigh.h"

layout(local_size_x = 4, local_size_y = 2) in;
layout(std140, binding = 0) uniform Params {
    SumFine params;
};
layout(std430, binding = 0) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];
};
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D lookupField;
layout(binding = 2) uniform sampler2D still;
layout(rgba32f, binding = 0) uniform writeonly highp image2D fineField;

float stillAt(ivec2 pixel) {
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 p = vec2(pixel) + 0.25 + 0.5 * vec2(i & 1, i >> 1);
        vec2 l = textureLod(lookupField, p / vec2(4 * ivec2(params.columns, params.rows)), 0.0).xy;
        vec2 at = p * vec2(params.scaleX, params.scaleY) + l;
        sum += linearly(still, at * vec2(params.texelX, params.texelY));
    }
    return 0.25 * sum;
}

vec3 sumsOfBlock(ivec2 first) {
    vec4 video, seen;
    for (int i = 0; i < 4; ++i) {
        ivec2 p = first + ivec2(i & 1, i >> 1);
        video[i] = 255.0 * lumaOf(texelFetch(picture, p, 0).rgb);
        seen[i] = 255.0 * stillAt(p);
    }
    video -= dot(video, vec4(0.25));
    seen -= dot(seen, vec4(0.25));
    return vec3(dot(video, video), dot(video, seen), dot(seen, seen)) / 8.0;
}

void main() {
    ivec2 sampled = ivec2(gl_GlobalInvocationID.xy), cell = sampled * ivec2(1, kFineStep);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    bool matched = tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x].y != 0u;
    bool isWhole = all(lessThanEqual(4 * cell + 4, ivec2(params.videoWidth, params.videoHeight)));
    vec3 sums = vec3(0.0);
    if (matched && isWhole)
        for (int i = 0; i < 2; ++i)
            sums += sumsOfBlock(4 * cell + ivec2(2 * i, 1));
    imageStore(fineField, sampled, vec4(sums, 0.0));
}
