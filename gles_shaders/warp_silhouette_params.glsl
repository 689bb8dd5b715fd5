// One mesh of the virtual scene; mirrors ModelSilhouette::Params.
layout(std140, binding = 0) uniform Params {
    vec4 object[3];   // rows of T_camera_object, the object's scale in them
    vec4 pinhole;     // of the layer's camera [px]
    vec4 distortion;  // k1, k2, p1, p2
    vec4 lens;        // k3, radius of the rim, radial factor there, near plane [m]
    vec4 target;      // width, height of the layer [px], number of the object, cut-off of its alpha
};
