// The lens model of base/geometry.h: pinhole with radial-tangential distortion.
// Rays are normalised (x/z, y/z); pixels have their centres at integers.

struct Camera {
    vec4 pinhole;     // fx, fy, cx, cy [px]
    vec4 distortion;  // k1, k2, p1, p2
    float k3;
};

vec2 distortRay(Camera c, vec2 p) {
    float r2 = dot(p, p);
    float radial = 1.0 + r2 * (c.distortion.x + r2 * (c.distortion.y + r2 * c.k3));
    vec2 t = c.distortion.zw;
    float xy = p.x * p.y;
    return p * radial +
           vec2(2.0 * t.x * xy + t.y * (r2 + 2.0 * p.x * p.x),
                t.x * (r2 + 2.0 * p.y * p.y) + 2.0 * t.y * xy);
}

vec2 projectRay(Camera c, vec2 ray) {
    return c.pinhole.xy * distortRay(c, ray) + c.pinhole.zw;
}

// Fixed-point iterations: for the lenses in use each gains a digit or more, and none can leave the
// neighbourhood of the pixel the way a Newton step at the model's fold can.
vec2 unprojectPixel(Camera c, vec2 pixel) {
    vec2 target = (pixel - c.pinhole.zw) / c.pinhole.xy;
    vec2 ray = target;
    for (int i = 0; i < 12; ++i) {
        ray += clamp(target - distortRay(c, ray), vec2(-0.5), vec2(0.5));
    }
    return ray;
}
