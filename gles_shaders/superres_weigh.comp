// Computes the weight of the still in each cell, from the statistics of 3x3 cells.
// In: images of superres_assess.comp, image of superres_gain.comp.
// Out: cells image = flow (x, y) [video px], weight of the detail, confidence (eq. 2 of
// the paper). Look-up image = LookUpCell: offset (x, y) [still px], weight, confidence plus jumps
// (see kJump). Weights image = weight / 2, confidence, share of the video's variance that is not noise (for the
// sharpening), TrustCell::unexplained.
// The weight of the detail is the product of the photometric gain between the sensors, the trust in
// the match and the confidence. The gain is covariance / (variance of the still + noise). It is
// also measured at half resolution. The more contrast the still has at half resolution, the more
// the larger of the two gains counts.
// Where the flow is uniform, both sensors see the surface from the same direction. The correlation
// of video and still at the video's resolution says little about detail that aliases in the video.
// A match that is probably correct is therefore trusted fully: its trust is kLookUpLoss (above 1).
// Where the flow varies, the still shows the surface from another direction. The trust is then the
// square of the share of the video's variance that the still explains. Where the flow is
// discontinuous, look-ups between cells are invalid, and the trust is 0.
// Range: cellField -2e4..2e4, -2e4..2e4, 0..2.31, 0..1
// Range: lookupField -4e3..4e3, -4e3..4e3, 0..2.31, 0..7
#include "pipeline/engine/params/weigh.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    WeighCells params;
};
layout(binding = 0) uniform sampler2D displacement;
layout(binding = 1) uniform sampler2D statistics;
layout(binding = 2) uniform sampler2D halfStatistics;
layout(rgba32f, binding = 0) uniform writeonly highp image2D cellField;
layout(rgba8, binding = 1) uniform writeonly highp image2D weightField;
layout(rgba16f, binding = 2) uniform writeonly highp image2D lookupField;

#include "flow_bend.glsl"

vec4 statisticsAt(ivec2 c) {
    return texelFetch(statistics, clamp(c, ivec2(0), lastCell()), 0);
}

vec3 halfAround(ivec2 cell) {
    vec3 sum = vec3(0.0);
    ivec2 last = ivec2(params.halfColumns, params.halfRows) - 1;
    ivec2 towards = (cell & 1) * 2 - 1;
    for (int i = 0; i < 4; ++i) {
        ivec2 c = (cell >> 1) + ivec2((i & 1) * towards.x, (i >> 1) * towards.y);
        sum += 0.25 * texelFetch(halfStatistics, clamp(c, ivec2(0), last), 0).xyz;
    }
    return sum;
}

// Returns `value` if the flow jumps between the cells `c` and c + by, otherwise 0; see kJump.
float jumpAt(ivec2 c, ivec2 by, float value) {
    vec2 here = flowAt(c), next = flowAt(c + by);
    float change = max(length(here - flowAt(c - by)), length(flowAt(c + 2 * by) - next));
    return length(next - here) > kJump + kJumpPerChange * change ? value : 0.0;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThan(cell, lastCell()))) return;
    vec3 sum = vec3(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += float((2 - abs(x)) * (2 - abs(y))) * statisticsAt(cell + ivec2(x, y)).xyz;
    sum /= 16.0;
    float covariance = max(sum.x, 0.0), varianceVideo = sum.y, varianceStill = sum.z;
    float confidence = statisticsAt(cell).w;

    float noise = kPatchPixels * (params.noise * params.noise + kByteVariance);
    float gain = covariance / (varianceStill + noise);
    vec3 low = halfAround(cell);
    float lowNoise = kPatchPixels * (0.25 * params.noise * params.noise + kByteVariance);
    float lowGain = max(low.x, 0.0) / (low.z + lowNoise);
    float lowShare = low.z / (low.z + kLowContrast * lowNoise);
    gain = min(mix(gain, max(gain, lowGain), lowShare), kLargestGain);
    float ncc2 = covariance * covariance / ((varianceVideo + noise) * (varianceStill + noise));
    float trust = mix(kLookUpLoss * smoothstep(kUnlikePatches, kAlikePatches, ncc2), ncc2 * ncc2, bentAt(cell));
    float torn = smoothstep(kSmoothStep, kTornStep, tearAt(cell));
    float weight = gain * trust * confidence * (1.0 - torn);
    if (!(weight > kSmallestWeight)) weight = 0.0;
    float signal = clamp((varianceVideo - 2.0 * noise) / (varianceVideo + noise), 0.0, 1.0);
    float textured = step(kTexturedContrast * (noise + kPatchPixels), varianceVideo);
    float unexplained = textured * step(ncc2 * confidence, kUnexplainedMatch);

    vec4 d = texelFetch(displacement, cell, 0);
    imageStore(cellField, cell, vec4(d.xy, weight, confidence));
    float jumps = jumpAt(cell, ivec2(1, 0), kJumpRight) + jumpAt(cell, ivec2(0, 1), kJumpBelow);
    imageStore(lookupField, cell, vec4(d.zw, weight, confidence + jumps));
    imageStore(weightField, cell, vec4(0.5 * weight, confidence, signal, unexplained));
}
