// Computes where the still shows an infinitely distant point that a video pixel shows. This depends
// on both lenses and on the rotation between the cameras, but not on parallax.
#include "camera.glsl"
#include "pipeline/engine/params/luma.h"

// Returns the position [still px] of the point that the video shows at `videoPixel`. It is far
// outside the still if the point is not in front of the still camera.
vec2 stillPixel(Rig r, vec2 videoPixel) {
    vec3 p = vec3(unprojectPixel(r.video, videoPixel), 1.0);
    vec3 s;
    for (int i = 0; i < 3; ++i) s[i] = dot(vec3(r.rotation[i].x, r.rotation[i].y, r.rotation[i].z), p);
    if (!(s.z > kLeastTurnedDepth)) return vec2(kFarOutside);
    return projectRay(r.still, s.xy / s.z);
}
