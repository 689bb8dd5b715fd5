// Light on the sensor to a picture: blur, gain, noise, gamma.
// in: linear radiance; out: RGBA8, alpha 1
layout(std140) uniform Params {
    vec4 gain;    // rgb; w: 1 / gamma
    vec4 kernel;  // blur: weights of the pixel, its side and its corner neighbours; w: 1 = blur
    vec4 noise;   // variance in linear units: x per unit of signal, y constant; z: 1 = noise
    uvec4 seed;
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

// Close to a normal distribution of variance 1: the sum of four bytes.
float bell(uint h) {
    float sum = float(h & 255u) + float((h >> 8) & 255u) + float((h >> 16) & 255u) + float(h >> 24);
    return (sum - 510.0) / 147.8;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 light = at(p);
    if (kernel.w > 0.5) {
        vec3 sides = at(p + ivec2(1, 0)) + at(p - ivec2(1, 0)) + at(p + ivec2(0, 1)) +
                     at(p - ivec2(0, 1));
        vec3 corners = at(p + ivec2(1, 1)) + at(p - ivec2(1, 1)) + at(p + ivec2(1, -1)) +
                       at(p - ivec2(1, -1));
        light = kernel.x * light + kernel.y * sides + kernel.z * corners;
    }
    vec3 signal = light * gain.rgb;
    if (noise.z > 0.5) {
        uint h = mixed(uint(p.x) + 4096u * uint(p.y) + mixed(seed.x));
        uvec3 each = uvec3(h, mixed(h + seed.y), mixed(h + 2u * seed.y + 1u));
        vec3 sigma = sqrt(max(signal, 0.0) * noise.x + noise.y);
        signal += sigma * vec3(bell(each.x), bell(each.y), bell(each.z));
    }
    pixel = vec4(pow(clamp(signal, 0.0, 1.0), vec3(gain.w)), 1.0);
}
