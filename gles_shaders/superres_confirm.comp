// Lowers the weights of cells in which the still does not show the video's finest detail; see
// kFineRoom.
// In: image of superres_fine.comp, images of superres_weigh.comp. Out: the images of
// superres_weigh.comp with the lowered weights.
// Range: newCells -2e4..2e4, -2e4..2e4, 0..2.31, 0..1
// Range: newLookUps -4e3..4e3, -4e3..4e3, 0..2.31, 0..1
#include "pipeline/engine/params/weigh.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    ConfirmCells params;
};
layout(binding = 0) uniform sampler2D fineField;
layout(binding = 1) uniform sampler2D cellField;
layout(binding = 2) uniform sampler2D weightField;
layout(binding = 3) uniform sampler2D lookupField;
layout(rgba32f, binding = 0) uniform writeonly highp image2D newCells;
layout(rgba8, binding = 1) uniform writeonly highp image2D newWeights;
layout(rgba16f, binding = 2) uniform writeonly highp image2D newLookUps;

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy), last = ivec2(params.columns, params.rows) - 1;
    if (any(greaterThan(cell, last))) return;
    int above = cell.y / kFineStep, below = min((cell.y + kFineStep - 1) / kFineStep, last.y / kFineStep);
    vec3 sum = vec3(0.0);
    for (int x = -1; x <= 1; ++x) {
        int column = clamp(cell.x + x, 0, last.x);
        sum += float(2 - abs(x)) * (texelFetch(fineField, ivec2(column, above), 0).xyz +
                                    texelFetch(fineField, ivec2(column, below), 0).xyz);
    }
    sum /= 8.0;
    float both = max(sum.y, 0.0);
    float unexplained = sum.x - both * both / (sum.z + kFineLeast);
    float allowed = kFineRoom * params.noise + kFineShareRoom * params.share * sum.x;
    float kept = allowed / max(unexplained, kFineLeast);
    if (!(kept < 1.0)) kept = 1.0;
    vec3 keptWeight = vec3(1.0, 1.0, kept);
    imageStore(newCells, cell, texelFetch(cellField, cell, 0) * vec4(keptWeight, 1.0));
    imageStore(newLookUps, cell, texelFetch(lookupField, cell, 0) * vec4(keptWeight, 1.0));
    imageStore(newWeights, cell, texelFetch(weightField, cell, 0) * vec4(kept, 1.0, 1.0, 1.0));
}
