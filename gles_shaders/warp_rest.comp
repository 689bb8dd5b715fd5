// Second pass of the warp for the pixels that warp_look_up.frag leaves: pixels at edges, whose
// coverage is a multiple of a quarter, and pixels that the traced picture does not show. If such a
// pixel belongs to an object, it is looked up in the re-rendered pictures, which contain pixels
// that were traced later to fill gaps.
// A pixel is composed of an object and, below it, the shadow catcher.
// In: list[] of warp_rest_list.comp. Out: colour, z and state of the pixels; holes[];
// holeCommands[].
// Components of the state. x: number of the surface whose colour is unknown. y: share of the pixel
// whose colour is unknown. z: 1 if an object fills the pixel and no picture shows it. w: number of
// the surface that fills the pixel, if the whole colour is known. A number is 0 if there is no such
// surface.
// holes[] = pixels whose colour is not wholly known: pixel index, colour so far (RGBA8). Bit 31 of
// the index: z of the state is 1. Bit 30: the pixel is at an edge.
// holeCommands[0] = number of rows of kListRow entries of holes[] (y), number of entries (w).
// holeCommands[l] = dispatch command for pyramid level l, written with the first entry of holes[].
// Range: depth 0..1e6
// Variant: #define MOVING
#include "warp_view_params.glsl"
#include "warp_view.glsl"
#include "warp_surface.glsl"
#include "warp_quarters.glsl"
#include "warp_known.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) uniform usampler2D silhouette;
layout(binding = 1) uniform sampler2D rays;
layout(binding = 0, rgba8) writeonly uniform image2D colour;
layout(binding = 1, r32f) writeonly uniform image2D depth;
layout(binding = 2, rgba8) writeonly uniform image2D state;
layout(std430, binding = 0) readonly buffer Commands {
    uvec4 commands[];
};
layout(std430, binding = 1) readonly buffer List {
    uint list[];
};
layout(std430, binding = 2) buffer HoleCommands {
    uvec4 holeCommands[];
};
layout(std430, binding = 3) writeonly buffer Holes {
    uvec2 holes[];
};

uvec4 groupsOf(DispatchGroups g) {
    return uvec4(g.x, g.y, g.z, g.count);
}

void main() {
    uint entry = gl_GlobalInvocationID.y * kListRow + gl_GlobalInvocationID.x;
    if (entry >= commands[0].w) return;
    int index = int(list[entry]);
    ivec2 p = ivec2(index % params.width, index / params.width);
    vec2 ray = texelFetch(rays, p, 0).rg;
    uvec4 s = textureGather(silhouette, (vec2(p) + 0.5) / vec2(layerSize()));
    uint id = mostOf(s);
    vec3 object = middleOf(s, id), catcher = middleOf(s, kCatcher);
    float covered = 0.25 * dot(vec4(notEqual(s & 0xffu, uvec4(0u))) * vec4(notEqual(s & 0xffu, uvec4(kCatcher))), vec4(1.0));
    catcher.z = catcher.z == 0.0 ? planeDepth(ray) : catcher.z;
    float below = catcher.z > 0.0 ? 1.0 - covered : 0.0;
    vec2 focal = vec2(params.projections[1].lens.fx, params.projections[1].lens.fy);
    vec3 point = object.z * vec3(ray + object.xy / focal, 1.0);
    vec3 under = catcher.z * vec3(ray + catcher.xy / focal, 1.0);
    vec4 ofObject, ofCatcher;
    float objectKnown = covered > 0.0 ? known(point, float(id), paintAt(p, s, id), ofObject) : 1.0;
    float catcherKnown = below > 0.0 ? known(under, float(kCatcher), Paint(vec3(0.0), vec3(0.0)), ofCatcher) : 1.0;
    vec4 shown = vec4(0.0);
    if (covered > 0.0) shown += covered * objectKnown * ofObject;
    if (below > 0.0) shown += below * catcherKnown * ofCatcher;
    bool missed = objectKnown < 1.0, hole = missed || catcherKnown < 1.0;
    bool open = objectKnown == 0.0 && covered == 1.0;
    // An edge pixel without a known colour is not rendered individually: the result would be a
    // mixture of the surfaces at the edge. It is filled from its neighbours instead.
    bool edge = (missed ? covered : below) < 1.0;
    float z = covered > 0.0 ? object.z : isShown(shown) || hole ? (1.0 - kShadowLift) * catcher.z : 0.0;
    float plain = hole ? 0.0 : covered == 1.0 ? float(id) : below == 1.0 ? float(kCatcher) : 0.0;
    float missing = missed ? float(id) : hole ? float(kCatcher) : 0.0;
    float part = missed ? covered * (1.0 - objectKnown) : below * (1.0 - catcherKnown);
    imageStore(colour, p, shown);
    imageStore(depth, p, vec4(z));
    imageStore(state, p, vec4(missing / 255.0, part, open ? 1.0 : 0.0, plain / 255.0));
    if (!hole) return;
    uint i = atomicAdd(holeCommands[0].w, 1u);
    if (i % kListRow == 0u) atomicAdd(holeCommands[0].y, 1u);
    if (i == 0u)
        for (int l = 0; l < params.levels; ++l) holeCommands[l + 1] = groupsOf(params.wanted[l]);
    holes[i] = uvec2(uint(index) | (edge ? 1u << 30 : open ? 1u << 31 : 0u), packUnorm4x8(shown));
}
