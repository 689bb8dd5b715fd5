// Renders the light on a simulated sensor that looks at the synthetic world. For each pixel,
// inverts the lens distortion, intersects four rays with the solids of the pixel's tile, and shades
// the points that the rays hit.
// In: tables of solids, surfaces and materials; a bit mask of solids per tile; textures; light map.
// Out: linear radiance; 1 is white paper in full light.
#include "synthetic_tables.glsl"
#include "hal/virtual/synthetic_params.h"

layout(std140) uniform Params {
    SyntheticWorld params;
};
layout(std430, binding = 0) readonly buffer Tiles { uvec4 tiles[]; };

layout(binding = 0) uniform highp sampler2DArray layers;
layout(binding = 1) uniform sampler2D lightMap;
out vec4 radiance;

const float kLayerTexels = 1024.0;
const float kVariationPerMetre = 0.55;
const float kLightFullScale = 1.6;

vec2 distort(vec2 p, out mat2 jacobian) {
    float r2 = dot(p, p);
    Lens lens = params.lens;
    float radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
    float slope = lens.k1 + r2 * (2.0 * lens.k2 + 3.0 * r2 * lens.k3);
    vec2 t = vec2(lens.p1, lens.p2);
    float cross = 2.0 * p.x * p.y * slope + 2.0 * t.x * p.x + 2.0 * t.y * p.y;
    jacobian = mat2(radial + 2.0 * p.x * p.x * slope + 2.0 * t.x * p.y + 6.0 * t.y * p.x, cross,
                    cross, radial + 2.0 * p.y * p.y * slope + 6.0 * t.x * p.y + 2.0 * t.y * p.x);
    return p * radial + vec2(2.0 * t.x * p.x * p.y + t.y * (r2 + 2.0 * p.x * p.x),
                             t.x * (r2 + 2.0 * p.y * p.y) + 2.0 * t.y * p.x * p.y);
}

// Returns the normalised ray of a pixel. The columns of `perPixel` are the derivatives of the ray
// by x and by y of the pixel.
vec2 unproject(vec2 pixel, out mat2 perPixel) {
    Lens lens = params.lens;
    vec2 target = (pixel - vec2(lens.cx, lens.cy)) / vec2(lens.fx, lens.fy);
    vec2 ray = target;
    mat2 jacobian;
    for (int i = 0; i < 4; ++i) {
        vec2 error = target - distort(ray, jacobian);
        perPixel = inverse(jacobian);
        ray += perPixel * error;
    }
    perPixel = mat2(perPixel[0] / lens.fx, perPixel[1] / lens.fy);
    return ray;
}

struct Group {
    int solid, axis;
    vec4 member;  // 1 for each of the four rays that hits this face, else 0
};

vec3 shade(Group g, vec4 t, vec2 rays[4], mat2 perPixel) {
    Solid s = solids[g.solid];
    Surface f = surfaces[g.solid];
    vec3 size = f.size.xyz;
    vec3 origin = vec3(s.x.w, s.y.w, s.z.w) * size;
    mat3 turn = transpose(mat3(s.x.xyz * size.x, s.y.xyz * size.y, s.z.xyz * size.z));
    vec3 p[4];
    vec3 middle = vec3(0.0);
    vec2 ray = vec2(0.0);
    float count = dot(g.member, vec4(1.0)), distance = dot(g.member, t) / count;
    for (int k = 0; k < 4; ++k) {
        p[k] = origin + t[k] * (turn * vec3(rays[k], 1.0));
        middle += g.member[k] * p[k];
        ray += g.member[k] * rays[k];
    }
    middle /= count;
    vec3 d = turn * vec3(ray / count, 1.0);
    Chart c = chart(f, g.axis, middle);

    Material m = materials[f.materials[g.axis]];
    vec3 across = turn * vec3(perPixel[0], 0.0), down = turn * vec3(perPixel[1], 0.0);
    float facing = dot(c.normal, d);
    facing = abs(facing) > 1e-4 ? facing : -1e-4;
    across = distance * (across - d * (dot(c.normal, across) / facing));
    down = distance * (down - d * (dot(c.normal, down) / facing));
    vec2 scale = abs(m.mapping.xy);
    float a2 = dot(pow2(vec2(dot(across, c.u), dot(across, c.v)) * scale), vec2(1.0));
    float b2 = dot(pow2(vec2(dot(down, c.u), dot(down, c.v)) * scale), vec2(1.0));
    // There are four samples, half a pixel apart. Along each axis, a sample covers half of the
    // pixel's footprint.
    float texels2 = 0.25 * kLayerTexels * kLayerTexels * max(min(a2, b2), 0.5 * max(a2, b2));
    float lod = max(0.0, 0.5 * log2(texels2));

    vec4 paint = vec4(0.0);
    for (int k = 0; k < 4; ++k) {
        vec3 off = p[k] - middle;
        vec2 uv = (c.at + vec2(dot(off, c.u), dot(off, c.v))) * m.mapping.xy + m.mapping.zw;
        paint += g.member[k] * textureLod(layers, vec3(uv, m.look.x), lod);
    }
    paint /= count;
    float slow = textureLod(layers, vec3(c.at * kVariationPerMetre, float(params.variationLayer)), 2.0).r;
    vec3 colour = paint.rgb * m.tint.rgb * (1.0 + m.tint.w * (2.0 * slow - 1.0));

    vec2 face = f.face.xy + f.face.zw * (vec2(float(g.axis), c.positive) + c.light);
    vec3 lit = kLightFullScale * textureLod(lightMap, face, 0.0).rgb;
    if (f.materials.w == 0)
        lit *= moverShade(vec3(ray / count, 1.0) * distance, vec3(params.moverX, params.moverY, params.moverZ),
                          vec4(params.lightX, params.lightY, params.lightZ, params.moverRadius));
    vec3 halfway = normalize(f.light.xyz - normalize(d));
    float shine = power64(max(dot(c.normal, halfway), 0.0));
    float rim = 1.0 - min(abs(facing) / length(d), 1.0);
    float gloss = m.look.y * paint.a * (0.9 * shine + 0.12 * rim * rim * rim * rim);
    return (colour + gloss) * lit;
}

void main() {
    mat2 perPixel;
    vec2 centre = unproject(gl_FragCoord.xy - 0.5, perPixel);
    vec2 rays[4];
    for (int k = 0; k < 4; ++k)
        rays[k] = centre + perPixel * (0.5 * vec2(float(k & 1), float(k >> 1)) - 0.25);
    ivec2 tile = ivec2(gl_FragCoord.xy) / kSyntheticTile;
    uvec4 mask = tiles[uint(tile.y) * params.tileColumns + uint(tile.x)];
    SolidMask b = params.boxes;
    uvec4 boxes = uvec4(b.first, b.second, b.third, b.fourth);
    vec4 t = vec4(1e9);
    ivec4 hit = ivec4(-1);
    for (int word = 0; word < 4; ++word) {
        for (uint bits = mask[word] & boxes[word]; bits != 0u; bits &= bits - 1u)
            castBox(32 * word + findLSB(bits), rays, t, hit);
        for (uint bits = mask[word] & ~boxes[word]; bits != 0u; bits &= bits - 1u)
            castRound(32 * word + findLSB(bits), rays, t, hit);
    }
    vec3 sum = vec3(0.0);
    vec4 left = vec4(1.0);
    for (int i = 0; i < 4 && dot(left, vec4(1.0)) > 0.0; ++i) {
        int first = left.x > 0.0 ? hit.x : left.y > 0.0 ? hit.y : left.z > 0.0 ? hit.z : hit.w;
        vec4 member = left * vec4(equal(hit, ivec4(first)));
        left -= member;
        vec3 colour = vec3(params.red, params.green, params.blue);
        if (first >= 0) colour = shade(Group(first / 4, first % 4, member), t, rays, perPixel);
        sum += 0.25 * dot(member, vec4(1.0)) * colour;
    }
    radiance = vec4(sum, 1.0);
}
