// Where a finished picture shows a point. Needs warp_view_params.glsl.
#include "lens_projection.glsl"

// `point` [m, the layer's camera] in view `v`: pixel, z; z = 0 where it cannot be looked up.
vec3 inView(int v, vec3 point) {
    vec4 p = vec4(point, 1.0);
    vec3 there = vec3(dot(toView[3 * v], p), dot(toView[3 * v + 1], p), dot(toView[3 * v + 2], p));
    int c = min(v, 1);
    bool before = there.z > lens[c].w && there.z < 1e6 && point.z > 0.0;
    vec3 h = projectPoint(Camera(pinhole[c], distortion[c], lens[c].x), lens[c].yz, before ? there : vec3(0.0, 0.0, 1.0));
    vec2 pixel = h.xy / h.z;
    vec2 size = vec2(v == 0 ? sizes.xy : sizes.zw);
    bool within = before && all(greaterThan(pixel, vec2(-1.0))) && all(lessThan(pixel, size));
    return within ? vec3(pixel, there.z) : vec3(0.0);
}
