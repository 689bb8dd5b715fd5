// Corrects the still's mean over each video pixel where the still is trusted: subtracts the
// difference between the guidance signal and the signal's local mean; see kGuideReach.
// In: result of superres_seen.frag. Out: the corrected mean luma of the still [1/64 grey level].
#include "tile_params.glsl"

layout(binding = 1) uniform isampler2D seen;
layout(location = 0) out ivec4 guided;

ivec3 seenAt(ivec2 p) {
    return texelFetch(seen, clamp(p, ivec2(0), videoSize() - 1), 0).rgb;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy), sum = ivec2(0);
    for (int y = -kGuideReach; y <= kGuideReach; ++y)
        for (int x = -kGuideReach; x <= kGuideReach; ++x)
            sum += seenAt(p + ivec2(x, y)).gb;
    ivec3 here = seenAt(p);
    float off = float(here.g) - float(sum.x) / float(max(sum.y, 1));
    guided = ivec4(floor(float(here.r) - float(here.b) * off + 0.5));
}
