// Lists the least exact pixels of a warped picture: those with the most contrast to their
// neighbours. There, the warp interpolated between colours that already are mixtures.
// The first pass (COUNT) counts the pixels of each contrast level from params.leastContrast on. The
// second pass lists whole contrast levels, highest first, until the next one would exceed the
// largest number of pixels (a share of the objects' pixels, with an upper limit). The highest level
// is always listed. The set of listed pixels does not depend on the order of the threads.
// In: colour (RGBA8 premultiplied) and state, from warp_look_up.frag and warp_rest.comp.
// Out: count[] = number of pixels of each contrast level, number of pixels that an object fills
// with a known colour, length of the list; list[] = row-major index and colour of each listed
// pixel.
// Variant: #define COUNT
#include "warp_edge_params.glsl"

const uint kLevels = kContrastLevels;

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D colour;
layout(binding = 1) uniform sampler2D state;
layout(std430, binding = 0) buffer Counts {
    uint count[];
};
#ifdef COUNT
shared uint own[kLevels], objects;
#else
layout(std430, binding = 1) writeonly buffer List {
    uvec2 list[];
};
shared uint least;
#endif

// Returns the contrast level at p: the largest difference of a colour channel within the 3x3 pixels
// around p, scaled to kLevels levels. Alpha is ignored: an object's alpha is exact even at its
// outline, because it comes from the silhouette at the current pose and not from the warp.
uint levelAt(ivec2 p) {
    vec3 low = vec3(1.0), high = vec3(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 q = clamp(p + ivec2(i % 3, i / 3) - 1, firstPixel(), endPixel() - 1);
        vec3 c = texelFetch(colour, q, 0).rgb;
        low = min(low, c);
        high = max(high, c);
    }
    vec3 d = high - low;
    return min(uint(max(max(d.r, d.g), d.b) * float(kLevels)), kLevels - 1u);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy) + firstPixel();
    bool inside = all(lessThan(p, endPixel()));
    uint level = inside ? levelAt(p) : 0u;
    uint i = gl_LocalInvocationIndex;
#ifdef COUNT
    own[i] = 0u;
    if (i == 0u) objects = 0u;
    barrier();
    if (level >= uint(params.leastContrast)) atomicAdd(own[level], 1u);
    float id = inside ? texelFetch(state, p, 0).a : 0.0;
    if (id > 0.0 && id < 1.0) atomicAdd(objects, 1u);
    barrier();
    if (own[i] > 0u) atomicAdd(count[i], own[i]);
    if (i == 0u && objects > 0u) atomicAdd(count[kLevels], objects);
#else
    if (i == 0u) {
        least = kLevels - 1u;
        uint sum = count[least], most = min(uint(params.listedShare * float(count[kLevels])), uint(params.mostListed));
        for (uint l = least; l-- > uint(params.leastContrast);) {
            sum += count[l];
            if (sum > most) break;
            least = l;
        }
    }
    barrier();
    if (!inside || level < least) return;
    list[atomicAdd(count[kLevels + 1u], 1u)] =
        uvec2(uint(p.y * params.width + p.x), packUnorm4x8(texelFetch(colour, p, 0)));
#endif
}
