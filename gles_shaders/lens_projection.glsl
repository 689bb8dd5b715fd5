// A camera's projection continued beyond the rim of its lens and behind it; twin of
// pipeline/composite/lens_projection.h.
#include "camera.glsl"

Lens Camera(vec4 pinhole, vec4 distortion, float k3) {
    return Lens(pinhole.x, pinhole.y, pinhole.z, pinhole.w, distortion.x, distortion.y, distortion.z,
                distortion.w, k3);
}

// Camera coordinates [m] to (w u, w v, w). rim: radius of the outermost ray that the model describes,
// radial factor of the distortion there.
vec3 projectPoint(Lens c, vec2 rim, vec3 p) {
    float r = length(p.xy);
    bool within = p.z * rim.x > r;
    vec2 held = within ? p.xy / p.z : p.xy * (rim.x / max(r, 1e-12));
    vec2 beyond = within ? vec2(0.0) : p.xy - p.z * held;
    return vec3(p.z * projectRay(c, held) + rim.y * vec2(c.fx, c.fy) * beyond, p.z);
}
