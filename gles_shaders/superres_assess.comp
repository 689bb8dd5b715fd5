// How the still matches the video at each cell: what superres_weigh.comp weighs.
// In: forward field (video -> still) and backward field, which may be of a coarser level, or two-way
// errors in patches[], both pictures' finest luma.
// Out: displacement image = flow (x, y) [video px], its end in the still less the scaled cell centre
// [still px]; statistics image = covariance, variance of the video and of the still in the patch,
// confidence; none of the first three in tiles that are not matched. Source: paper, eq. 2 with lambda(x) = min(x, 1).
// Range: displacement -2e4..2e4, -2e4..2e4, -4e3..4e3, -4e3..4e3
// Range: statistics -4.2e6..4.2e6, 0..4.2e6, 0..4.2e6, 0..1
#include "luma.glsl"
#include "rig.glsl"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    Rig rig;
    ivec4 video;     // finest level of the video: offset, pitch, width, height
    ivec4 still;     // finest level of the still at the video's geometry
    ivec4 cells;     // cells a row, rows; those of the backward field
    ivec4 offsets;   // in patches[]: forward field, backward field; 1 = that holds two-way errors; pixels a
                     // pixel of the backward field's level
    vec4 tune;       // alpha [px], -, -, -
    vec4 stillSize;  // still width, height, still px per video px (x, y)
};
layout(std430, binding = 0) readonly buffer Luma {
    uint luma[];
};
layout(std430, binding = 1) readonly buffer Patches {
    vec4 patches[];
};
layout(std430, binding = 2) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];  // changed, matched; a workgroup each
};
layout(rgba32f, binding = 0) uniform writeonly highp image2D displacement;
layout(rgba32f, binding = 1) uniform writeonly highp image2D statistics;

#include "patch.glsl"

vec2 backward(ivec2 c) {
    c = clamp(c, ivec2(0), cells.zw - 1);
    return float(offsets.w) * patches[offsets.y + c.y * cells.z + c.x].xy;
}

vec2 backwardAt(vec2 p) {
    vec2 g = (p + 0.5) / float(4 * offsets.w) - 0.5;
    ivec2 i = ivec2(floor(g));
    vec2 f = g - floor(g);
    vec2 top = mix(backward(i), backward(i + ivec2(1, 0)), f.x);
    vec2 bottom = mix(backward(i + ivec2(0, 1)), backward(i + ivec2(1, 1)), f.x);
    return mix(top, bottom, f.y);
}

bool inside(vec2 p, vec2 size) {
    return p.x >= 0.0 && p.y >= 0.0 && p.x <= size.x - 1.0 && p.y <= size.y - 1.0;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, cells.xy))) return;
    vec2 u = patches[offsets.x + cell.y * cells.x + cell.x].xy;
    vec3 alike = vec3(0.0);
    if (tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x].y != 0u)
        alike = spreadOf(levelOf(video), levelOf(still), cell, u);

    vec2 centre = 4.0 * vec2(cell) + 1.5;
    vec2 q = centre + u;
    vec2 inStill = stillPixel(rig, q);
    float confidence = 0.0;
    if (inside(q, vec2(video.zw)) && inside(inStill, stillSize.xy)) {
        float d = offsets.z != 0 ? patches[offsets.y + cell.y * cells.x + cell.x].x
                                 : length(u + backwardAt(q));
        confidence = d < tune.x ? 1.0 - d / tune.x : 0.0;
    }

    vec2 offset = clamp(inStill - (centre + 0.5) * stillSize.zw + 0.5, vec2(-4e3), vec2(4e3));
    imageStore(displacement, cell, vec4(u, offset));
    imageStore(statistics, cell, vec4(alike, confidence));
}
