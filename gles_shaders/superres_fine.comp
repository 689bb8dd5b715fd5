// Compares the finest detail of video and still in each cell; see kFineRoom. The finest detail
// consists of the differences between neighbouring pixels.
// In: states of the tiles, look-ups, luma of the still with amplified finest detail, video,
// statistics of superres_assess.comp.
// Out: the means of three products of such differences [grey levels^2]: video * video, video *
// still and still * still. Each mean is over the middle two rows of the cell, and is halved. All
// are zero in tiles that are not matched and in cells that are only partly inside the frame. The
// fourth value is the variance of the video's patch [grey levels^2].
// One workgroup per tile, one invocation per cell. The loops count from cell.x, so that compilers
// cannot unroll them.
// Range: fineField 0..32513, -32513..32513, 0..32513, 0..6.6e4
#include "look_up_cells.glsl"
#include "luma.glsl"
#include "still_linear.glsl"
#include "pipeline/engine/params/weigh.h"

layout(local_size_x = 4, local_size_y = 4) in;
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
layout(binding = 3) uniform sampler2D statistics;
layout(rgba32f, binding = 0) uniform writeonly highp image2D fineField;

float stillAt(int first, ivec2 pixel) {
    float sum = 0.0;
    for (int i = first; i < first + 4; ++i) {
        vec2 p = vec2(pixel) + 0.25 + 0.5 * vec2((i - first) & 1, (i - first) >> 1);
        vec2 l = lookUpCells(lookupField, p, ivec2(params.columns, params.rows)).xy;
        vec2 at = p * vec2(params.scaleX, params.scaleY) + l;
        sum += linearly(still, at * vec2(params.texelX, params.texelY));
    }
    return 0.25 * sum;
}

// Returns the luma of video (x) and still (y) [grey levels].
vec2 bothAt(int first, ivec2 pixel) {
    ivec2 p = ivec2(min(pixel.x, params.videoWidth - 1), pixel.y);
    return 255.0 * vec2(lumaOf(texelFetch(picture, p, 0).rgb), stillAt(first, p));
}

vec3 productsOf(vec2 difference) {
    return difference.xxy * difference.xyy;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    bool matched = tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x].y != 0u;
    bool isWhole = all(lessThanEqual(4 * cell + 4, ivec2(params.videoWidth, params.videoHeight)));
    vec3 sums = vec3(0.0);
    if (matched && isWhole) {
        ivec2 first = 4 * cell + ivec2(0, 1);
        vec2 upper = vec2(0.0), lower = upper, above = upper;
        for (int i = cell.x; i < cell.x + 10; ++i) {
            int k = i - cell.x;
            vec2 both = bothAt(cell.x, first + ivec2(k >> 1, k & 1));
            if ((k & 1) == 0) {
                above = both;
                continue;
            }
            if (k > 1) sums += productsOf(above - upper) + productsOf(both - lower);
            if (k < 9) sums += productsOf(both - above);
            upper = above;
            lower = both;
        }
    }
    float variance = texelFetch(statistics, cell, 0).y / kPatchPixels;
    imageStore(fineField, cell, vec4(sums / 24.0, variance));
}
