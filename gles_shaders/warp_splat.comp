// Where the pixels of a picture go at the current pose: the nearest z of those that reach each pixel. A pixel goes
// to those of its four neighbours whose bilinear weight exceeds a quarter, which the
// middle between four does to all. In: z [m] and number of each pixel. Out: nearest[] = bits of z, of the
// objects, then of the catcher. Atomic minima: no order changes them. Source: paper, section on image-based rendering.
layout(local_size_x = 8, local_size_y = 8) in;
#include "lens_projection.glsl"

layout(std140, binding = 0) uniform Params {
    vec4 fromView[3];   // rows of T_camera_view
    vec4 pinhole;       // of the layer's camera [px]
    vec4 distortion;    // k1, k2, p1, p2
    vec4 lens;          // k3, radius of the rim, radial factor there, near plane [m]
    ivec4 from;         // pixels of the picture: x0 <= x < x1, y0 <= y < y1
    ivec4 sizes;        // width, height of the layer, -, -
};
layout(binding = 0) uniform sampler2D surfaces;  // see warp_view.glsl
layout(binding = 1) uniform sampler2D rays;      // of the picture's pixels
layout(std430, binding = 0) buffer Nearest {
    uint nearest[];
};

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy) + from.xy;
    if (any(greaterThanEqual(p, from.zw))) return;
    vec4 s = texelFetch(surfaces, p, 0);
    if (!(s.x > 0.0)) return;
    vec4 there = vec4(s.x * vec3(texelFetch(rays, p, 0).rg, 1.0), 1.0);
    vec3 point = vec3(dot(fromView[0], there), dot(fromView[1], there), dot(fromView[2], there));
    if (!(point.z > lens.w && point.z < 1e6)) return;
    vec3 h = projectPoint(Camera(pinhole, distortion, lens.x), lens.yz, point);
    vec2 at = h.xy / h.z;
    if (!(all(greaterThan(at, vec2(-1.0))) && all(lessThan(at, vec2(sizes.xy))))) return;
    vec2 low = floor(at), f = at - low;
    int plane = s.y == 255.0 ? sizes.x * sizes.y : 0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        ivec2 q = ivec2(low) + side;
        vec2 near = mix(1.0 - f, f, vec2(side));
        if (near.x * near.y < 0.25 || any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, sizes.xy))) continue;
        atomicMin(nearest[plane + q.y * sizes.x + q.x], floatBitsToUint(point.z));
    }
}
