// Finds where a traced or re-rendered picture shows a point. Needs warp_view_params.glsl.
#include "lens_projection.glsl"

#ifdef MOVING
// The rows of the transform from the layer's camera to each view, for each surface number. The
// transform depends on the surface, because an object may have moved since the view's picture was
// traced.
layout(binding = 6) uniform sampler2D motions;

vec3 placeIn(int v, uint id, vec3 point) {
    int row = kSurfaceNumbers * v + int(id);
    vec4 p = vec4(point, 1.0);
    return vec3(dot(texelFetch(motions, ivec2(0, row), 0), p), dot(texelFetch(motions, ivec2(1, row), 0), p), dot(texelFetch(motions, ivec2(2, row), 0), p));
}
#else
vec3 placeIn(int v, uint id, vec3 point) {
    return transformed(params.views[v].toView, point);
}
#endif

// `point` [m] of surface `id` is in coordinates of the layer's camera. Returns the point's pixel in
// view `v` and its z in that view's camera; z = 0 if the view cannot show the point. View 0 is the
// traced picture; the others are re-rendered pictures.
vec3 inView(int v, uint id, vec3 point) {
    vec3 there = placeIn(v, id, point);
    int c = min(v, 1);
    bool before = there.z > params.projections[c].nearPlane && there.z < 1e6 && point.z > 0.0;
    vec3 h = projectPoint(params.projections[c], before ? there : vec3(0.0, 0.0, 1.0));
    vec2 pixel = h.xy / h.z;
    vec2 size = vec2(v == 0 ? tracedSize() : layerSize());
    bool within = before && all(greaterThan(pixel, vec2(-1.0))) && all(lessThan(pixel, size));
    return within ? vec3(pixel, there.z) : vec3(0.0);
}
