// Finds the virtual pixels that are certainly in front of or certainly behind the real scene.
// In: virtual z [m]; result of visibility_range.frag. Out: visibility, R8, 1 or 0; fragment depth:
// 0 for decided pixels, otherwise 1. The depth test then skips the decided pixels when
// visibility_sample.frag runs. On a software renderer, a branch in that shader would save no time.
#include "visibility.glsl"
#include "virtual_layer.glsl"

layout(binding = 0) uniform sampler2D virtualDepth;
layout(binding = 1) uniform sampler2D rangeField;
// A vec4, because Mesa 22.3 for Mali crashes if a shader that writes depth has a single output
// channel.
layout(location = 0) out vec4 visibility;

void main() {
    float z = layerDepth(virtualDepth);
    bool there = z > 0.0;
    float inverse = 1.0 / (there ? z : 1.0);
    ivec2 base = ivec2(floor(inVideo()));
    vec2 range = texelFetch(rangeField, clamp(base, ivec2(0), lastVideoPixel()), 0).rg;
    bool before = inverse >= range.x;
    bool behind = inverse * (1.0 + (params.bias + params.softness) * params.virtualSigma) <= range.y;
    visibility = vec4(there && before ? 1.0 : 0.0);
    gl_FragDepth = there && !before && !behind ? 1.0 : 0.0;
}
