// Inverse depth from flow: rho = (u . e) / (|e|^2 - b_z (u . e)), e = b_xy - (x, y) b_z.
// In: flow [px], rays of both views. Out: points[], see pipeline/depth/triangulation.h.
// Source: design, section 3; the sign is that of u = rho e / (1 + rho b_z).
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
    float along = dot(s.u, s.e);
    float d = dot(s.e, s.e) - s.b.z * along;
    store(p, s, d > 0.0 ? along / d : 0.0);
}
