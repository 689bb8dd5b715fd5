// The depth that was splatted, as pictures. In: nearest[] of warp_splat.comp. Out: z [m] of the objects, of the
// catcher, 0 = nothing.
// Range: objects 0..1e6
// Range: catcher 0..1e6
#include "pipeline/warp/pass_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    ResolveSplat params;
};
layout(std430, binding = 0) readonly buffer Nearest {
    uint nearest[];
};
layout(binding = 0, r32f) writeonly uniform image2D objects;
layout(binding = 1, r32f) writeonly uniform image2D catcher;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy) + ivec2(params.bounds.x0, params.bounds.y0);
    if (any(greaterThanEqual(p, ivec2(params.bounds.x1, params.bounds.y1)))) return;
    int i = p.y * params.width + p.x;
    float z = uintBitsToFloat(nearest[i]), below = uintBitsToFloat(nearest[params.width * params.height + i]);
    imageStore(objects, p, vec4(z < 1e6 ? z : 0.0));
    imageStore(catcher, p, vec4(below < 1e6 ? below : 0.0));
}
