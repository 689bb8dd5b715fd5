// The still at the video's scale, on its own pixel grid: mean over the footprint of a video pixel. In: RGBA8 still. Out: luma, 8 bits.
#include "luma.glsl"
#include "pipeline/engine/params/still.h"

layout(std140, binding = 0) uniform Params {
    StillLow params;
};
layout(binding = 0) uniform sampler2D still;
layout(location = 0) out vec4 low;

void main() {
    vec2 centre = gl_FragCoord.xy * vec2(params.texelX, params.texelY);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 16; ++i) {
        vec2 off = vec2(i & 3, i >> 2) - 1.5;
        sum += textureLod(still, centre + off * vec2(params.tapX, params.tapY), 0.0).rgb;
    }
    low = vec4(lumaOf(sum / 16.0));
}
