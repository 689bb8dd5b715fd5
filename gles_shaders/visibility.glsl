// Parameters of the composite's passes (mirrors Composite::Params), and what counts as known.
layout(std140, binding = 0) uniform Params {
    ivec4 video;  // width, height; width, height of the output
    ivec4 layer;  // width, height of the virtual layer
    vec4 scale;   // video pixels per output pixel (x, y), layer pixels per output pixel
    vec4 tune;    // bias [sigmas], softness [sigmas], virtual sigma [share of depth],
                  // likeness [1 / colour distance^2]
};

// Of a real sample: inverse depth [1/m], sigma [1/m]. False for NaN, infinity, zero and below, and for
// denormal sigmas, which are zero to some GPUs.
bool known(vec2 real) {
    return real.x > 1e-6 && real.x < 1e6 && real.y > 1e-20 && real.y < 1e6;
}
