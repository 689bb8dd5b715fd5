// Projects the vertices of the virtual scene for the current pose. In: positions in the model's
// coordinates [m].
#include "warp_silhouette_params.glsl"
#include "lens_projection.glsl"

layout(location = 0) in vec3 position;
layout(location = 2) in vec2 uv;
out vec2 texel;

void main() {
    vec3 point = transformed(params.object, position);
    texel = uv;
    vec3 h = projectPoint(params.layer, point);
    gl_Position = vec4((2.0 * h.xy + h.z) / vec2(params.width, params.height) - h.z,
                       h.z - 2.0 * params.layer.nearPlane, h.z);
}
