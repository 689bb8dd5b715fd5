// Projects points to pixels, including points outside the lens's field of view and behind the
// camera. Must give the same results as pipeline/composite/lens_projection.h.
#include "camera.glsl"
#include "pipeline/composite/pass_params.h"

vec3 transformed(Transform t, vec3 p) {
    vec3 to;
    for (int i = 0; i < 3; ++i)
        to[i] = dot(vec4(t.rows[i].x, t.rows[i].y, t.rows[i].z, t.rows[i].w), vec4(p, 1.0));
    return to;
}

// Projects a point in camera coordinates [m] to homogeneous pixel coordinates (w u, w v, w), where
// w is the point's z.
vec3 projectPoint(Projection c, vec3 p) {
    float r = length(p.xy);
    bool within = p.z * c.rim > r;
    vec2 held = within ? p.xy / p.z : p.xy * (c.rim / max(r, 1e-12));
    vec2 beyond = within ? vec2(0.0) : p.xy - p.z * held;
    return vec3(p.z * projectRay(c.lens, held) + c.rimRadial * vec2(c.lens.fx, c.lens.fy) * beyond, p.z);
}
