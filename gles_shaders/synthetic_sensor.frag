// Converts the light on a simulated sensor to a picture: applies blur, gain, noise and gamma.
// In: linear radiance. Out: RGBA8, alpha 1.
#include "hal/virtual/synthetic_params.h"

layout(std140) uniform Params {
    SyntheticSensor params;
};
layout(binding = 0) uniform sampler2D radiance;
out vec4 pixel;

vec3 at(ivec2 p) {
    return texelFetch(radiance, clamp(p, ivec2(0), textureSize(radiance, 0) - 1), 0).rgb;
}

uint mixed(uint h) {
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}

// Returns a random number with approximately normal distribution, mean 0 and variance 1: the scaled
// sum of the four bytes of a hash.
float bell(uint h) {
    float sum = float(h & 255u) + float((h >> 8) & 255u) + float((h >> 16) & 255u) + float(h >> 24);
    return (sum - 510.0) / 147.8;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 light = at(p);
    if (params.blurs != 0) {
        vec3 sides = at(p + ivec2(1, 0)) + at(p - ivec2(1, 0)) + at(p + ivec2(0, 1)) +
                     at(p - ivec2(0, 1));
        vec3 corners = at(p + ivec2(1, 1)) + at(p - ivec2(1, 1)) + at(p + ivec2(1, -1)) +
                       at(p - ivec2(1, -1));
        light = params.centreWeight * light + params.sideWeight * sides + params.cornerWeight * corners;
    }
    vec3 signal = light * vec3(params.redGain, params.greenGain, params.blueGain);
    if (params.noisy != 0) {
        uint h = mixed(uint(p.x) + 4096u * uint(p.y) + mixed(params.seed));
        uvec3 each = uvec3(h, mixed(h + params.channelSeed), mixed(h + 2u * params.channelSeed + 1u));
        vec3 sigma = sqrt(max(signal, 0.0) * params.noisePerSignal + params.noiseConstant);
        signal += sigma * vec3(bell(each.x), bell(each.y), bell(each.z));
    }
    pixel = vec4(pow(clamp(signal, 0.0, 1.0), vec3(params.inverseGamma)), 1.0);
}
