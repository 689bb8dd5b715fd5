// Corrects the weights, which are too cautious because they were computed without the finest
// detail. Raises all weights below 1. Then lowers the weights of cells in which the still does not
// show the video's finest detail. See kFineRoom.
// In: image of superres_fine.comp, images of superres_weigh.comp. Out: the images of
// superres_weigh.comp with the new weights.
// Range: newCells -2e4..2e4, -2e4..2e4, 0..2.31, 0..1
// Range: newLookUps -4e3..4e3, -4e3..4e3, 0..2.31, 0..7
#include "pipeline/engine/params/weigh.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    ConfirmCells params;
};
layout(binding = 0) uniform sampler2D fineField;
layout(binding = 1) uniform sampler2D displacement;
layout(binding = 2) uniform sampler2D weightField;
layout(binding = 3) uniform sampler2D lookupField;
layout(rgba32f, binding = 0) uniform writeonly highp image2D newCells;
layout(rgba8, binding = 1) uniform writeonly highp image2D newWeights;
layout(rgba16f, binding = 2) uniform writeonly highp image2D newLookUps;

#include "flow_bend.glsl"

vec4 meansAround(ivec2 cell) {
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 c = clamp(cell + ivec2(x, y), ivec2(0), lastCell());
            sum += float((2 - abs(x)) * (2 - abs(y))) * texelFetch(fineField, c, 0);
        }
    return sum / 16.0;
}

float keptShare(ivec2 cell) {
    vec4 sum = meansAround(cell);
    float both = max(sum.y, 0.0);
    float unexplained = sum.x - both * both / (sum.z + kFineLeast);
    float allowed = kFineRoom * params.noise + kFineShareRoom * params.share * sum.x;
    float limited = min(allowed / max(unexplained, kFineLeast), 1.0);
    float rough = smoothstep(kFineTexture, kRoughTexture, sum.x / (sum.w + kFineLeast));
    float wrong = max(unexplained - kFineNoise * params.noise, 0.0);
    float perVideo = 1.0 / (sum.x + kFineLeast);
    float explained = 1.0 - wrong * perVideo;
    explained *= explained;
    float detail = (sum.z + kFineLeast) * perVideo;
    float alias = rough * (1.0 - smoothstep(kAliasedStill, kDetailedStill, detail));
    float kink = bentAt(cell) * tearAt(cell);
    float kinked = mix(smoothstep(kFlatKink, kSharpKink, kink),
                       smoothstep(kFlatRoughKink, kSharpRoughKink, kink), alias);
    float kept = mix(mix(limited, 1.0, rough), explained * explained, kinked);
    return kept < 1.0 ? kept : 1.0;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThan(cell, lastCell()))) return;
    vec4 weighed = texelFetch(displacement, cell, 0);
    float lack = (1.0 - weighed.z) * (1.0 - weighed.z);
    float weight = keptShare(cell) * (weighed.z < 1.0 ? 1.0 - lack * lack : weighed.z);
    imageStore(newCells, cell, vec4(weighed.xy, weight, weighed.w));
    vec4 looked = texelFetch(lookupField, cell, 0);
    imageStore(newLookUps, cell, vec4(looked.xy, weight, looked.w));
    imageStore(newWeights, cell, vec4(0.5 * weight, texelFetch(weightField, cell, 0).yzw));
}
