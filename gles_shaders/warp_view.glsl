// Finds where a traced or re-rendered picture shows a point. Needs warp_view_params.glsl.
#include "lens_projection.glsl"

// `point` [m] is in coordinates of the layer's camera. Returns the point's pixel in view `v` and
// its z in that view's camera; z = 0 if the view cannot show the point. View 0 is the traced
// picture; the others are re-rendered pictures.
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
