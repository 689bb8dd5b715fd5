// Computes how the light on the traced picture's objects looks from the current position of the
// camera (the eye). Mirrored light of the sky and the sun depends on the eye. So it is computed
// again from each pixel's normal and roughness, and mirror images and highlights move as in
// reality. Must give the same results as pipeline/simd/mirror_rows.cpp.
// In: the traced picture's LightWords, packed surfaces and GlossWords; the layer's rays.
// Out: see struct Light in warp_light.glsl.
// Range: diffuse 0..65280, 0..65280, 0..65280, 1..1
// Range: specular 0..65280, 0..65280, 0..65280, 0..1
#include "pipeline/warp/pass_params.h"
#include "warp_surface.glsl"
#include "warp_light.glsl"

layout(std140, binding = 0) uniform Params {
    EyeLight params;
};
layout(binding = 0) uniform usampler2D lights;
layout(binding = 1) uniform usampler2D surfaces;
layout(binding = 2) uniform usampler2D glosses;
layout(binding = 3) uniform sampler2D rays;
// The tables of MirrorLight, one below the other.
layout(binding = 4) uniform sampler2D tables;
// Row i describes how a surface of roughness i / 255 mirrors light: by a mixture of two tables.
// Texel 0: first row of the first table in `tables`, edge length of this table, weight of the
// second table, GGX parameter alpha. Texel 1: first row and edge length of the second table.
layout(binding = 5) uniform sampler2D looks;
layout(location = 0) out vec4 diffuse;
layout(location = 1) out vec4 specular;

vec3 xyz(Row4 row) {
    return vec3(row.x, row.y, row.z);
}

// Octahedral map: directions with z < 0 lie in the corners of the square, where |x| + |y| > 1. For
// z < 0, moves p from the inner part (|x| + |y| <= 1) to the corners, or from the corners to the
// inner part. For other z, returns p unchanged.
vec2 folded(float z, vec2 p) {
    vec2 other = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
    return z < 0.0 ? other : p;
}

vec3 normalOf(uint word) {
    vec2 p = vec2(word & 0xffffu, word >> 16) * (2.0 / 65535.0) - 1.0;
    float z = 1.0 - abs(p.x) - abs(p.y);
    return normalize(vec3(folded(z, p), z));
}

vec3 fromTable(vec2 table, vec2 direction) {
    float last = table.y - 1.0;
    vec2 at = clamp(0.5 * last * (direction + 1.0), vec2(0.0), vec2(last));
    return textureLod(tables, (at + vec2(0.5, table.x + 0.5)) / vec2(textureSize(tables, 0)), 0.0).rgb;
}

float fresnel(float facing, float cosine) {
    float rest = 1.0 - min(cosine, 1.0), square = rest * rest;
    return facing + (1.0 - facing) * square * square * rest;
}

// A pixel's surface as a mirror. `facing`: reflectance for light along the normal. `full`:
// SpecularAlbedo::full(). `first`, `second`: the texels of the row of `looks` for its roughness.
struct Mirror {
    vec3 normal;
    float facing, full;
    vec4 first, second;
};

// Returns the sunlight that a surface with GGX roughness mirrors towards `wo`, divided by the sun's
// irradiance and by the surface's paint.
float sunShare(Mirror m, vec3 wo, float cosO) {
    vec3 sun = xyz(params.towardsSun), h = normalize(wo + sun);
    float cosI = max(dot(m.normal, sun), 0.0), cosH = max(dot(wo, h), 0.0);
    float cosN = min(dot(m.normal, h), 1.0);
    float a2 = m.first.w * m.first.w, rest = 1.0 - a2;
    float slope = 1.0 - cosN * cosN * rest;
    float density = a2 * 0.318309886 / (slope * slope);
    float seen = 0.5 / max(cosI * sqrt(cosO * cosO * rest + a2) + cosO * sqrt(cosI * cosI * rest + a2), 1e-6);
    return density * seen * cosI * fresnel(m.facing, cosH) / max(fresnel(m.facing, cosO), 1e-3);
}

// Light that the pixel would mirror towards `wo` if no object hid sky or sun.
struct FarLight {
    vec3 sky, sun;
};

FarLight mirrored(Mirror m, vec3 wo) {
    float cosO = max(dot(m.normal, wo), 0.02);
    vec3 towards = 2.0 * cosO * m.normal - wo;
    vec3 p = towards / max(dot(abs(towards), vec3(1.0)), 1e-6);
    vec2 at = folded(towards.z, p.xy);
    vec3 sky = params.least + mix(fromTable(m.first.xy, at), fromTable(m.second.xy, at), m.first.z);
    float sun = sunShare(m, wo, cosO);
    return FarLight(m.full * params.exposure * sky, params.exposure * sun * xyz(params.irradiance));
}

float luminance(vec3 light) {
    return dot(light, vec3(0.2126, 0.7152, 0.0722));
}

// Converts specular light from the traced picture's camera to the eye. `all` is the light that the
// camera sees. `before` and `now` are the far light that camera and eye would see if nothing hid
// it. Estimates which shares of `before` are contained in `all`. Returns the same shares of `now`,
// plus the part of `all` that is not far light.
vec3 seenFrom(vec3 all, FarLight before, FarLight now) {
    float ofSky = luminance(before.sky), ofSun = luminance(before.sun);
    // If a pixel mirrors little sunlight, sky and sun get the same share.
    bool bright = ofSun > 0.1 * ofSky;
    vec3 share = clamp(all / max(before.sky + (bright ? vec3(0.0) : before.sun), vec3(1e-9)), 0.0, 1.0);
    float sunPart = clamp((luminance(all) - ofSky) / max(ofSun, 1e-9), 0.0, 1.0);
    sunPart = bright ? sunPart : luminance(share);
    vec3 rest = max(all - before.sky - sunPart * before.sun, vec3(0.0));
    return min(share * now.sky + sunPart * now.sun + rest, vec3(65280.0));
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    Light light = unpackWords(texelFetch(lights, p, 0).rg);
    diffuse = light.diffuse;
    specular = light.specular;
    if (params.mirrors == 0) return;
    uint surface = texelFetch(surfaces, p, 0).r;
    uvec2 gloss = texelFetch(glosses, p, 0).rg;
    if (surfaceId(surface) == 0u || gloss.y == 0u) return;
    int roughness = int(gloss.y & 255u);
    Mirror m = Mirror(normalOf(gloss.x), float((gloss.y >> 8) & 255u) / 255.0, float((gloss.y >> 16) & 255u) / 255.0,
                      texelFetch(looks, ivec2(0, roughness), 0), texelFetch(looks, ivec2(1, roughness), 0));
    vec3 ray = vec3(texelFetch(rays, p, 0).rg, 1.0);
    vec3 along = vec3(dot(xyz(params.axes[0]), ray), dot(xyz(params.axes[1]), ray), dot(xyz(params.axes[2]), ray));
    vec3 point = surfaceDepth(surface) * along;
    specular.rgb = seenFrom(light.specular.rgb, mirrored(m, normalize(-point)), mirrored(m, normalize(xyz(params.eye) - point)));
}
