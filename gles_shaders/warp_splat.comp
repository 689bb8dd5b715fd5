// Where the pixels of a picture go at the current pose: the nearest z of those that reach each pixel. A pixel goes
// to those of its four neighbours whose bilinear weight exceeds a quarter, which the
// middle between four does to all. In: z [m] and number of each pixel. Out: nearest[] = bits of z, of the
// objects, then of the catcher. Atomic minima: no order changes them. Source: paper, section on image-based rendering.
layout(local_size_x = 8, local_size_y = 8) in;
#include "lens_projection.glsl"
#include "pipeline/warp/pass_params.h"

layout(std140, binding = 0) uniform Params {
    SplatDepth params;
};
layout(binding = 0) uniform sampler2D surfaces;  // see warp_view.glsl
layout(binding = 1) uniform sampler2D rays;      // of the picture's pixels
layout(std430, binding = 0) buffer Nearest {
    uint nearest[];
};

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy) + ivec2(params.from.x0, params.from.y0);
    if (any(greaterThanEqual(p, ivec2(params.from.x1, params.from.y1)))) return;
    vec4 s = texelFetch(surfaces, p, 0);
    if (!(s.x > 0.0)) return;
    vec3 point = transformed(params.fromView, s.x * vec3(texelFetch(rays, p, 0).rg, 1.0));
    if (!(point.z > params.layer.nearPlane && point.z < 1e6)) return;
    vec3 h = projectPoint(params.layer, point);
    ivec2 size = ivec2(params.width, params.height);
    vec2 at = h.xy / h.z;
    if (!(all(greaterThan(at, vec2(-1.0))) && all(lessThan(at, vec2(size))))) return;
    vec2 low = floor(at), f = at - low;
    int plane = s.y == float(kCatcherNumber) ? size.x * size.y : 0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        ivec2 q = ivec2(low) + side;
        vec2 near = mix(1.0 - f, f, vec2(side));
        if (near.x * near.y < 0.25 || any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, size))) continue;
        atomicMin(nearest[plane + q.y * size.x + q.x], floatBitsToUint(point.z));
    }
}
