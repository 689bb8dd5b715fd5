// Where a video pixel at infinity lies in the still: rotation and both lenses, no parallax.
#include "camera.glsl"

struct Rig {
    vec4 videoPinhole;
    vec4 videoDistortion;
    vec4 stillPinhole;
    vec4 stillDistortion;
    vec4 k3;           // video, still, -, -
    vec4 rotation[3];  // rows of R_still_video
};

// Still pixel of a video pixel; far outside when the ray points away from the still's scene.
vec2 stillPixel(Rig r, vec2 videoPixel) {
    vec2 ray = unprojectPixel(Camera(r.videoPinhole, r.videoDistortion, r.k3.x), videoPixel);
    vec3 p = vec3(ray, 1.0);
    vec3 s = vec3(dot(r.rotation[0].xyz, p), dot(r.rotation[1].xyz, p), dot(r.rotation[2].xyz, p));
    if (!(s.z > 0.05)) return vec2(-1e6);
    return projectRay(Camera(r.stillPinhole, r.stillDistortion, r.k3.y), s.xy / s.z);
}
