// Position of a point in a finished picture. Needs warp_view_params.glsl.
#include "lens_projection.glsl"

// `point` [m] is in the frame of the layer's camera. Returns its pixel in view `v` and z there; z =
// 0 if the point cannot be looked up.
vec3 inView(int v, vec3 point) {
    vec3 there = transformed(params.views[v].toView, point);
    int c = min(v, 1);
    bool before = there.z > params.projections[c].nearPlane && there.z < 1e6 && point.z > 0.0;
    vec3 h = projectPoint(params.projections[c], before ? there : vec3(0.0, 0.0, 1.0));
    vec2 pixel = h.xy / h.z;
    vec2 size = vec2(v == 0 ? tracedSize() : layerSize());
    bool within = before && all(greaterThan(pixel, vec2(-1.0))) && all(lessThan(pixel, size));
    return within ? vec3(pixel, there.z) : vec3(0.0);
}
