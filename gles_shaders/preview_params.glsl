// One virtual object of the preview; mirrors PreviewRenderer::Params.
layout(std140, binding = 0) uniform Params {
    vec4 object[3];   // rows of T_video_object
    vec4 size;        // extent of the object [m]; w: squares along each side
    vec4 pinhole;     // of the video camera at the output's resolution [px]
    vec4 distortion;  // k1, k2, p1, p2
    vec4 lens;        // k3, radius of the rim, radial factor there, near plane [m]
    vec4 colour[2];   // of the squares, display values
    vec4 light;       // unit vector towards it, camera frame; w: share of the ambient light
    vec4 target;      // width, height [px]; of the unit shape: largest coordinate, largest square of the radius
};
