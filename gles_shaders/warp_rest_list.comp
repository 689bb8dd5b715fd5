// Lists the pixels that warp_look_up.frag left to warp_rest.comp. One invocation processes a square
// of 2x2 pixels, because most squares contain no such pixel.
// In: state of warp_look_up.frag. Out: list[] = row-major indices of the pixels; commands[0] =
// number of rows of kListRow entries (y), number of entries (w). The order of the list varies, but
// no result depends on it.
#include "warp_view_params.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D state;
layout(std430, binding = 0) buffer Commands {
    uvec4 commands[];
};
layout(std430, binding = 1) writeonly buffer List {
    uint list[];
};

void main() {
    ivec2 p = 2 * ivec2(gl_GlobalInvocationID.xy) + ivec2(params.bounds.x0, params.bounds.y0);
    vec4 left = textureGather(state, vec2(p + 1) / vec2(layerSize()), 1);
    ivec2 end = ivec2(params.bounds.x1, params.bounds.y1);
    // The components are in the order of textureGather().
    bvec4 within = bvec4(all(lessThan(p + ivec2(0, 1), end)), all(lessThan(p + 1, end)),
                         all(lessThan(p + ivec2(1, 0), end)), all(lessThan(p, end)));
    uvec4 some = uvec4(greaterThan(left, vec4(0.5))) & uvec4(within);
    uint count = some.x + some.y + some.z + some.w;
    if (count == 0u) return;
    uint i = atomicAdd(commands[0].w, count);
    // Number of rows of the list whose first entry is one of the new entries.
    uint rows = (i + count + kListRow - 1u) / kListRow - (i + kListRow - 1u) / kListRow;
    if (rows > 0u) atomicAdd(commands[0].y, rows);
    uint first = uint(p.y * params.width + p.x), row = uint(params.width);
    if (some.w != 0u) list[i] = first;
    i += some.w;
    if (some.z != 0u) list[i] = first + 1u;
    i += some.z;
    if (some.x != 0u) list[i] = first + row;
    i += some.x;
    if (some.y != 0u) list[i] = first + row + 1u;
}
