// Computes colour and depth of a virtual object with a checkerboard, in diffuse and ambient light.
// In: outputs of preview.vert. Out: colour, RGBA8, premultiplied by the coverage (0 or 1); z [m].
// Range: depth 0..4e5
#include "preview_params.glsl"

in vec3 point;
in vec3 facing;
in vec2 square;
in vec3 place;
layout(location = 0) out vec4 shown;
layout(location = 1) out float depth;

vec3 colourOf(Colour c) {
    return vec3(c.red, c.green, c.blue);
}

void main() {
    vec2 width = fwidth(square);  // undefined after a discard
    // GL rounds the corners of triangles to a grid. If a triangle seen edge-on is thinner than one
    // step of the grid, a pixel in the rounded triangle may be far outside the true one. The colour
    // and depth of such a pixel are meaningless.
    if (any(greaterThan(abs(place), vec3(params.reach))) || dot(place, place) > params.squaredRadius) discard;
    vec3 n = normalize(facing);
    if (dot(n, point) > 0.0) n = -n;
    float lit = mix(max(dot(n, vec3(params.lightX, params.lightY, params.lightZ)), 0.0), 1.0, params.ambient);
    // Signed distance [px] to the nearest line between squares of the checkerboard. At such a line,
    // the colour changes over a width of one pixel. A face's border does not count as such a line,
    // because the colour beyond it may be the same.
    vec2 inner = clamp(square, vec2(0.5), vec2(params.squares - 0.5));
    vec2 wave = 2.0 * abs(fract(0.5 * inner + 0.25) - 0.5) - 0.5;
    vec2 side = clamp(wave / max(width, 1e-6), vec2(-0.5), vec2(0.5));
    shown = vec4(lit * mix(colourOf(params.colours[0]), colourOf(params.colours[1]), 0.5 - 2.0 * side.x * side.y), 1.0);
    depth = max(1.0 / gl_FragCoord.w, params.projection.nearPlane);
}
