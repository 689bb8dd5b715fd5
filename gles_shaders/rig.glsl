// Position in the still of a video pixel at infinite distance: rotation and both lenses, no
// parallax.
#include "camera.glsl"
#include "pipeline/engine/params/luma.h"

// Still pixel of a video pixel. It is far outside the still if the ray points away from the still
// camera's view.
vec2 stillPixel(Rig r, vec2 videoPixel) {
    vec3 p = vec3(unprojectPixel(r.video, videoPixel), 1.0);
    vec3 s;
    for (int i = 0; i < 3; ++i) s[i] = dot(vec3(r.rotation[i].x, r.rotation[i].y, r.rotation[i].z), p);
    if (!(s.z > kLeastTurnedDepth)) return vec2(kFarOutside);
    return projectRay(r.still, s.xy / s.z);
}
