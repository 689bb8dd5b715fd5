// What the look-up of a warp needs; mirrors ViewLookUp::Params.
layout(std140, binding = 0) uniform Params {
    vec4 toView[15];     // rows of T_view_camera: of the reference, then of the patches
    vec4 pinhole[2];     // of the reference, of the layer (and the patches) [px]
    vec4 distortion[2];  // k1, k2, p1, p2
    vec4 lens[2];        // k3, radius of the rim, radial factor there, near plane [m]
    vec4 plane;          // the catcher, if it is one: n . point = w, the layer's camera [m]; else 0
    vec4 share;          // of each patch in what is shown
    vec4 slack;          // factor of the reference's tolerance of depth, least weight of a look-up, -, -
    ivec4 sizes;         // width, height of the reference; of the layer [px]
    ivec4 bounds;        // pixels x0 <= x < x1, y0 <= y < y1
    ivec4 counts;        // patches, levels of the pyramid, -, -
    uvec4 wanted[6];     // groups of the dispatches of its levels
};

// z [m] of the catcher's plane along a ray, 0 = not in sight.
float planeDepth(vec2 ray) {
    float facing = dot(plane.xyz, vec3(ray, 1.0));
    float z = plane.w / (facing == 0.0 ? 1.0 : facing);
    return z > lens[1].w && z < 1e6 ? z : 0.0;
}
