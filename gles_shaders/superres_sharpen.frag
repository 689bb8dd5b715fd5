// Sharpens the video where the still does not supply detail. This restores high frequencies that
// the area of a sensor pixel and the enlargement by Keys' cubic weaken. The filter is the sum of a
// horizontal filter, a vertical filter and the product of their near parts. A near part has only
// the taps at the centre and next to it.
// In: video, weights, look-ups, luma of the still with amplified finest detail.
// Out: sharpened video, to be enlarged; alpha: mean luma of the still over the pixel, which
// composite_detail.frag subtracts.

#include "tile_params.glsl"
#include "still_seen.glsl"

layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D weightField;
layout(location = 0) out vec4 colour;

vec3 at(ivec2 p) {
    return texelFetch(picture, clamp(p, ivec2(0), videoSize() - 1), 0).rgb;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 centre = at(p);
    vec3 near = at(p + ivec2(1, 0)) + at(p - ivec2(1, 0)) + at(p + ivec2(0, 1)) + at(p - ivec2(0, 1));
    vec3 far = at(p + ivec2(2, 0)) + at(p - ivec2(2, 0)) + at(p + ivec2(0, 2)) + at(p - ivec2(0, 2));
    vec3 diagonal = at(p + ivec2(1, 1)) + at(p - ivec2(1, 1)) + at(p + ivec2(1, -1)) + at(p - ivec2(1, -1));
    vec3 high = kSharpenNear * (near - 4.0 * centre) + kSharpenFar * (far - 4.0 * centre) +
                kSharpenNear * kSharpenNear * (diagonal - 2.0 * near + 4.0 * centre);
    vec4 w = textureLod(weightField, gl_FragCoord.xy / (4.0 * vec2(cellCount())), 0.0);
    float strength = params.sharpening * (1.0 - min(2.0 * w.x, 1.0)) * w.z;
    colour = vec4(centre + strength * high, stillMeans().x);
}
