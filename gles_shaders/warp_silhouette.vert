// Vertices of the virtual scene at the current pose. In: the model's frame [m].
// Variant: #define ALPHA_MASK
#include "warp_silhouette_params.glsl"
#include "lens_projection.glsl"

layout(location = 0) in vec3 position;
#ifdef ALPHA_MASK
layout(location = 2) in vec2 uv;
out vec2 texel;
#endif

void main() {
    vec4 p = vec4(position, 1.0);
    vec3 point = vec3(dot(object[0], p), dot(object[1], p), dot(object[2], p));
#ifdef ALPHA_MASK
    texel = uv;
#endif
    vec3 h = projectPoint(Camera(pinhole, distortion, lens.x), lens.yz, point);
    // Pixel centres are at integers; infinite far plane.
    gl_Position = vec4((2.0 * h.xy + h.z) / target.xy - h.z, h.z - 2.0 * lens.w, h.z);
}
