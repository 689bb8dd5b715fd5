// Inverse depth of the midpoint of the shortest line between both rays.
// In: flow [px], rays of both views. Out: points[], see pipeline/depth/triangulation.h.
// Source: paper; P = A[R|t] = [Q|q~], c = -Q^-1 q~, w = c + lambda Q^-1 m. The ends of the line follow from
// the rays' common normal, which the residual flow gives without cancellation.
// Range: points 0..1e6, 0..1e9, -1e9..1e9, 0..1e35
#include "triangulation.glsl"

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, sizes.xy))) return;
    Parallax s;
    if (!parallaxAt(p, s)) {
        storeNothing(p);
        return;
    }
    vec3 n = vec3(-s.u.y, s.u.x, crossOf(s.ray, s.u));
    vec3 first = vec3(s.ray, 1.0);
    vec3 second = vec3(s.ray + s.u, 1.0);
    vec3 c = -s.b;
    float lengths = dot(n, n);
    float onFirst = dot(cross(c, second), n);  // times |n|^2
    float onSecond = dot(cross(c, first), n);
    float z = 0.5 * (onFirst + onSecond + lengths * c.z);
    bool ahead = onFirst > 0.0 && onSecond > 0.0 && z > 0.0;
    store(p, s, ahead ? lengths / z : 0.0);
}
