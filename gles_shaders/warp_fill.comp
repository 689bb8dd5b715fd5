// Fills listed pixels without a known colour from the pyramid of warp_pull.comp. Finer pyramid
// levels come first; each level fills the share of a pixel that the finer levels leave unfilled.
// An object without any known colour, for example one that has just emerged from behind others,
// gets the colour of the objects around it.
// A pixel belongs to a crack if it is at an edge, or if its surface fills at least five of its
// eight neighbours with a known colour. Cracks are always filled.
// In: list[] (holes[] of warp_rest.comp) and state of warp_rest.comp; pyramid. Out: colours of the
// listed pixels, RGBA8 premultiplied; bit 30 in list[] marks a crack.
#include "warp_hole_params.glsl"
#include "warp_pyramid.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) uniform sampler2D state;
layout(binding = 0, rgba8) writeonly uniform image2D colour;
layout(std430, binding = 0) readonly buffer Commands {
    uvec4 commands[];
};
layout(std430, binding = 1) buffer List {
    uvec2 list[];
};
layout(std430, binding = 2) readonly buffer Pyramid {
    uvec4 texels[];
};

const uint kAnyObject = kAnyObjectNumber;

// Samples the surface `id` in pyramid level l at pixel p, bilinearly. Gives the sum of colour times
// weight, and the sum of the weights.
void sampleLevel(int l, ivec2 p, uint id, out vec4 sum, out float weights) {
    HoleLevel level = params.levels[l - 1];
    int count = (l < params.levelCount ? params.levels[l].first : params.texels) - level.first;
    vec2 at = (vec2(p) + 0.5) / float(1 << l) - 0.5;
    vec2 low = floor(at), f = at - low;
    sum = vec4(0.0);
    weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        ivec2 q = ivec2(low) + side - originOf(level);
        if (any(lessThan(q, ivec2(0))) || q.x >= level.columns || q.y * level.columns + q.x >= count) continue;
        Area area = unpackArea(texels[level.first + q.y * level.columns + q.x]);
        vec2 near = mix(1.0 - f, f, vec2(side));
        bool catcher = id == kCatcherNumber;
        bool shown = area.id == id || id == kAnyObject;
        float w = near.x * near.y * (catcher ? area.weights.y : shown ? area.weights.x : 0.0);
        sum += w * (catcher ? area.catcher : area.object);
        weights += w;
    }
}

bool isCrack(ivec2 p, float id) {
    int same = 0;
    for (int i = 0; i < 9; ++i) {
        ivec2 q = p + ivec2(i % 3, i / 3) - 1;
        bool within = all(greaterThanEqual(q, firstPixel())) && all(lessThan(q, endPixel()));
        q = clamp(q, firstPixel(), endPixel() - 1);
        same += within && i != 4 && texelFetch(state, q, 0).a == id ? 1 : 0;
    }
    return same >= 5;
}

void gather(ivec2 p, uint id, int last, out vec4 sum, out float weight) {
    sum = vec4(0.0);
    weight = 0.0;
    for (int l = 1; l <= last && weight < 0.99; ++l) {
        vec4 c;
        float w;
        sampleLevel(l, p, id, c, w);
        sum += (1.0 - weight) * c;
        weight += (1.0 - weight) * w;
    }
}

void main() {
    uint i = gl_GlobalInvocationID.y * kListRow + gl_GlobalInvocationID.x;
    if (i >= commands[0].w) return;
    uvec2 entry = list[i];
    int index = int(entry.x & 0x3fffffffu);
    ivec2 p = ivec2(index % params.width, index / params.width);
    vec4 own = texelFetch(state, p, 0);
    uint id = uint(own.r * 255.0 + 0.5);
    bool crack = (entry.x & (1u << 30)) != 0u || isCrack(p, own.r);
    if (crack) list[i].x = entry.x | (1u << 30);
    bool fills = (id == kCatcherNumber ? params.fillsCatcher : params.fillsObjects) != 0;
    if (!crack && !fills) return;
    vec4 sum;
    float weight;
    int last = fills ? params.levelCount : kCrackLevels;
    gather(p, id, last, sum, weight);
    if (weight == 0.0 && id != kCatcherNumber) gather(p, kAnyObject, last, sum, weight);
    if (weight > 0.0) imageStore(colour, p, min(unpackUnorm4x8(entry.y) + own.g * sum / weight, vec4(1.0)));
}
