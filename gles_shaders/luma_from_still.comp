// Finest pyramid level of the still, at the video's geometry and scale: luma of the still averaged over
// the footprint of each video pixel. In: RGBA8 still. Out: luma words. One invocation a word.
#include "luma.glsl"
#include "rig.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    Rig rig;
    ivec4 target;     // offset, pitch, width, height
    vec4 stillTexel;  // 1 / still size, footprint of a video pixel [still px], -
};
layout(binding = 0) uniform sampler2D still;
layout(std430, binding = 0) writeonly buffer Luma {
    uint luma[];
};

const int kTaps = 4;  // each way; bilinear, so that 4 taps cover a footprint of up to 8 px

float footprintMean(vec2 centre) {
    vec3 sum = vec3(0.0);
    for (int j = 0; j < kTaps; ++j) {
        for (int i = 0; i < kTaps; ++i) {
            vec2 off = (vec2(i, j) + 0.5) / float(kTaps) - 0.5;
            vec2 q = centre + off * stillTexel.z;
            sum += textureLod(still, (q + 0.5) * stillTexel.xy, 0.0).rgb;
        }
    }
    return 255.0 * lumaOf(sum) / float(kTaps * kTaps);
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= target.y || at.y >= target.w) return;
    vec4 v;
    for (int i = 0; i < 4; ++i) {
        int x = clamp(4 * (at.x - kMarginWords) + i, 0, target.z - 1);
        v[i] = footprintMean(stillPixel(rig, vec2(x, at.y)));
    }
    luma[target.x + at.y * target.y + at.x] = packPixels(v);
}
