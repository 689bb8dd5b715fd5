// Undoes what a sensor pixel's area and the bicubic kernel together take from high frequencies, where
// the still does not supply them. In: video, weights. Out: video, prefiltered for the upscaling.
// The taps are the first two of the inverse of (bicubic kernel, a = -0.75, averaged over a pixel), which
// has 1.207, -0.141, 0.044, -0.008, ...; the second stands for all further ones, so that the filter keeps
// its centre and a sum of one. Each axis, and the product of the axes' nearest taps.

#include "tile_params.glsl"
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D weightField;
layout(location = 0) out vec4 colour;

const float kNear = -0.14123;
const float kFar = 0.0385;

vec3 at(ivec2 p) {
    return texelFetch(picture, clamp(p, ivec2(0), video.xy - 1), 0).rgb;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 centre = at(p);
    vec3 near = at(p + ivec2(1, 0)) + at(p - ivec2(1, 0)) + at(p + ivec2(0, 1)) + at(p - ivec2(0, 1));
    vec3 far = at(p + ivec2(2, 0)) + at(p - ivec2(2, 0)) + at(p + ivec2(0, 2)) + at(p - ivec2(0, 2));
    vec3 diagonal = at(p + ivec2(1, 1)) + at(p - ivec2(1, 1)) + at(p + ivec2(1, -1)) + at(p - ivec2(1, -1));
    vec3 high = kNear * (near - 4.0 * centre) + kFar * (far - 4.0 * centre) +
                kNear * kNear * (diagonal - 2.0 * near + 4.0 * centre);
    vec4 w = textureLod(weightField, gl_FragCoord.xy / (4.0 * vec2(video.zw)), 0.0);
    float strength = tune.x * (1.0 - min(2.0 * w.x, 1.0)) * w.z;
    colour = vec4(centre + strength * high, 1.0);
}
