// Projects the vertices of a virtual object through the video camera's lens.
// In: vertices of the unit shape. Out: position in camera coordinates [m], normal, position on the
// checkerboard [squares], position on the unit shape.
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
    vec3 size = vec3(params.width, params.height, params.depth);
    // A normal must be divided by the size along each axis. Multiplying each component by the sizes
    // along the two other axes gives the same direction, even if one size is zero.
    vec3 n = normal * size.yzx * size.zxy;
    point = transformed(params.object, position * size);
    for (int i = 0; i < 3; ++i) {
        Row4 row = params.object.rows[i];
        facing[i] = dot(vec3(row.x, row.y, row.z), n);
    }
    square = uv * params.squares;
    place = position;
    vec3 h = projectPoint(params.projection, point);
    // Pixel centres are at integers. The far plane is at infinity.
    gl_Position = vec4((2.0 * h.xy + h.z) / vec2(params.targetWidth, params.targetHeight) - h.z,
                       h.z - 2.0 * params.projection.nearPlane, h.z);
}
