// Removes outliers and noise from a flow field. First, x and y of each flow vector are replaced by
// their medians over 3x3 cells. Then params.planeFits planes are fitted, one after the other, to
// the unfiltered vectors of the surrounding 5x5 cells: the first to vectors close to the median,
// the next to vectors close to the first plane. Medians over more cells were worse in measurements
// on photographs, because they flatten slanted and curved surfaces.
// In, out: two fields in cells[]. Tiles that are not matched keep their flow vectors. One
// invocation per cell.
// Range: cells -2e4..2e4, -2e4..2e4, 0..2.02, 0..4.2e6
#include "pipeline/engine/params/flow.h"

layout(local_size_x = 4, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    FilterFlow params;
};
layout(std430, binding = 1) buffer Cells {
    vec4 cells[];
};
layout(std430, binding = 2) readonly buffer Tiles {
    uvec2 header;
    uvec2 tiles[];
};

#include "flow_cells.glsl"

struct Plane {
    vec2 value, dx, dy;  // flow at the cell [px], change of the flow per cell
};

// Fits a plane to the flow vectors of the neighbours. `about` is the plane of the previous round,
// or in the first round the median. Neighbours that are less reliable or differ more from `about`
// have smaller weights. From a difference of `reach` [px] on, the weight is zero, so that the other
// side of a depth edge has no influence.
Plane planeAt(ivec2 cell, Plane about, float reach) {
    float w0 = 0.0;
    vec2 wx = vec2(0.0), u0 = vec2(0.0), ux = vec2(0.0), uy = vec2(0.0);
    vec3 wxx = vec3(0.0);
    for (int j = -kCleanUpRadius; j <= kCleanUpRadius; ++j) {
        for (int i = -kCleanUpRadius; i <= kCleanUpRadius; ++i) {
            vec4 n = cellIn(cell + ivec2(i, j));
            vec2 d = n.xy - about.value - float(i) * about.dx - float(j) * about.dy;
            float near = max(1.0 - dot(d, d) / (reach * reach), 0.0);
            float known = n.w / (n.w + kHalfTrusted) * max(1.0 - 2.0 * n.z, 0.0);
            float w = near * (near * known + kLeastPlaneWeight);
            w0 += w;
            wx += w * vec2(i, j);
            wxx += w * vec3(i * i, i * j, j * j);
            u0 += w * d;
            ux += w * float(i) * d;
            uy += w * float(j) * d;
        }
    }
    // Normal equations. The slopes are damped, because a single neighbour does not determine a
    // plane.
    float damp = kSlopeDamping + kSlopeDampingPerWeight * w0;
    mat3 m = mat3(w0 + 1e-6, wx.x, wx.y, wx.x, wxx.x + damp, wxx.y, wx.y, wxx.y, wxx.z + damp);
    float det = determinant(m);
    if (!(det > 1e-9)) return about;
    mat3 inverse = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])) / det;
    about.value += inverse[0].x * u0 + inverse[0].y * ux + inverse[0].z * uy;
    about.dx += inverse[1].x * u0 + inverse[1].y * ux + inverse[1].z * uy;
    about.dy += inverse[2].x * u0 + inverse[2].y * ux + inverse[2].z * uy;
    return about;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.columns, params.rows)))) return;
    if (params.byTile != 0 && tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x].y == 0u) {
        cells[params.target + cell.y * params.columns + cell.x] = cellIn(cell);
        return;
    }
    Plane plane = Plane(medianAround(cell), vec2(0.0), vec2(0.0));
    for (int i = 0; i < params.planeFits; ++i) plane = planeAt(cell, plane, i == 0 ? kFirstPlaneReach : kPlaneReach);
    cells[params.target + cell.y * params.columns + cell.x] = vec4(plane.value, cellIn(cell).zw);
}
