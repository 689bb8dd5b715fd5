// Vertices of a virtual object, seen through the video camera's lens. In: unit shape.
// Out: camera frame [m], squares of the checkerboard, place on the unit shape.
#include "preview_params.glsl"
#include "lens_projection.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
out vec3 point;
out vec3 facing;
out vec2 square;
out vec3 place;

void main() {
    vec4 p = vec4(position * size.xyz, 1.0);
    // Normals stretch by the inverse of the size; times all three, so that none may be zero.
    vec3 n = normal * size.yzx * size.zxy;
    point = vec3(dot(object[0], p), dot(object[1], p), dot(object[2], p));
    facing = vec3(dot(object[0].xyz, n), dot(object[1].xyz, n), dot(object[2].xyz, n));
    square = uv * size.w;
    place = position;
    vec3 h = projectPoint(Camera(pinhole, distortion, lens.x), lens.yz, point);
    // Pixel centres are at integers; infinite far plane.
    gl_Position = vec4((2.0 * h.xy + h.z) / target.xy - h.z, h.z - 2.0 * lens.w, h.z);
}
