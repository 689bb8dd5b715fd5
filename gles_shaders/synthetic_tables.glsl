// Tables of the synthetic world, and functions that intersect rays with its solids. A solid is a
// box, a cylinder or an ellipsoid. Rays are transformed to scaled coordinates in which the solid is
// a cube, a cylinder or a sphere that reaches from -1 to 1 along each axis.

struct Solid {
    // Transform from camera to scaled coordinates, one row per component. xyz of a row multiply a
    // direction; w is one component of the camera's position in scaled coordinates.
    vec4 x, y, z;
};
struct Surface {
    vec4 size;        // half extents [m]; w: 0 box, 1 cylinder, 2 ellipsoid
    vec4 face;        // in the light map, xy: corner of the first face; zw: size of a face
    // xyz: direction to the key light in the solid's frame; w: half a texel of the light map
    // divided by a face's width.
    vec4 light;
    ivec4 materials;  // indices in `materials` of the x, y and z faces; w: 1 if the solid moves
};
struct Material {
    vec4 mapping;  // xy: repeats of the texture per metre in u and v; zw: offset
    vec4 tint;     // rgb: colour factor; w: strength of the slow variation of brightness
    vec4 look;     // x: index of the texture layer; y: strength of the gloss
};
layout(std140, binding = 1) uniform Solids { Solid solids[128]; };
layout(std140, binding = 2) uniform Surfaces { Surface surfaces[128]; };
layout(std140, binding = 3) uniform Materials { Material materials[128]; };

vec2 pow2(vec2 v) {
    return v * v;
}

float power64(float v) {
    v *= v;
    v *= v;
    v *= v;
    v *= v;
    v *= v;
    return v * v;
}

vec3 local(Solid s, vec2 ray) {
    vec3 d = vec3(dot(s.x.xy, ray) + s.x.z, dot(s.y.xy, ray) + s.y.z, dot(s.z.xy, ray) + s.z.z);
    return mix(d, vec3(1e-9), lessThan(abs(d), vec3(1e-9)));
}

void castBox(int index, vec2 rays[4], inout vec4 t, inout ivec4 hit) {
    Solid s = solids[index];
    vec3 o = vec3(s.x.w, s.y.w, s.z.w);
    for (int k = 0; k < 4; ++k) {
        vec3 inv = 1.0 / local(s, rays[k]);
        vec3 enter = -o * inv - abs(inv), leave = -o * inv + abs(inv);
        float a = max(enter.x, max(enter.y, enter.z)), b = min(leave.x, min(leave.y, leave.z));
        if (a < b && a > 0.0 && a < t[k]) {
            t[k] = a;
            hit[k] = 4 * index + (a == enter.x ? 0 : a == enter.y ? 1 : 2);
        }
    }
}

void castRound(int index, vec2 rays[4], inout vec4 t, inout ivec4 hit) {
    Solid s = solids[index];
    bool ball = surfaces[index].size.w > 1.5;
    vec3 o = vec3(s.x.w, s.y.w, s.z.w);
    vec3 keep = vec3(1.0, 1.0, ball ? 1.0 : 0.0);
    for (int k = 0; k < 4; ++k) {
        vec3 d = local(s, rays[k]);
        vec3 dk = d * keep, ok = o * keep;
        float a = dot(dk, dk), b = dot(ok, dk);
        // The ray's point nearest to the axis or centre is used, because the discriminant b*b - a*c
        // would lose precision at a large distance.
        vec3 nearest = ok - dk * (b / a);
        float disc = (1.0 - dot(nearest, nearest)) / a;
        if (!(disc > 0.0)) continue;
        float root = sqrt(disc), enter = -b / a - root, leave = -b / a + root;
        int axis = 0;
        if (ball) {
            vec3 p = abs(o + enter * d);
            axis = p.x >= p.y && p.x >= p.z ? 0 : p.y >= p.z ? 1 : 2;
        } else {
            float slab = -o.z / d.z - abs(1.0 / d.z);
            leave = min(leave, -o.z / d.z + abs(1.0 / d.z));
            if (slab > enter) {
                enter = slab;
                axis = 2;
            }
        }
        if (enter < leave && enter > 0.0 && enter < t[k]) {
            t[k] = enter;
            hit[k] = 4 * index + axis;
        }
    }
}

struct Chart {
    vec2 at;
    vec3 u, v;
    vec3 normal;
    vec2 light;
    float positive;
};

Chart chart(Surface f, int axis, vec3 p) {
    Chart c;
    vec3 unit = p / f.size.xyz;
    bool tube = f.size.w == 1.0 && axis < 2, ball = f.size.w > 1.5;
    vec3 own = axis == 0 ? vec3(1.0, 0.0, 0.0)
             : axis == 1 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    c.positive = dot(unit, own) > 0.0 ? 1.0 : 0.0;
    c.u = axis == 0 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    c.v = axis == 2 ? vec3(0.0, -1.0, 0.0) : vec3(0.0, 0.0, -1.0);
    c.at = vec2(dot(p, c.u), dot(p, c.v));
    vec2 st = axis == 0 ? unit.yz : axis == 1 ? unit.zx : unit.xy;
    c.normal = own * (2.0 * c.positive - 1.0);
    if (ball) {
        st /= max(abs(dot(unit, own)), 1e-6);
        c.normal = normalize(unit / f.size.xyz);
    }
    if (tube) {
        float angle = atan(unit.x, -unit.y);
        c.normal = normalize(vec3(unit.xy / f.size.xy, 0.0));
        c.u = vec3(-c.normal.y, c.normal.x, 0.0);
        c.at.x = angle * f.size.x;
        st = vec2(angle / 3.14159265, unit.z);
        c.positive = 0.0;
    }
    float inset = f.light.w;
    c.light = clamp(0.5 * st + 0.5, vec2(inset), vec2(1.0 - inset));
    return c;
}

// Returns the factor by which the moving object's shadow darkens a point. (The light map contains
// only the shadows of static objects.) The moving object is treated as a sphere around `middle`.
// `light`: xyz: direction to the light; w: radius of the sphere, 0 without a moving object.
float moverShade(vec3 point, vec3 middle, vec4 light) {
    vec3 v = point - middle;
    float along = dot(v, light.xyz), off = length(v - along * light.xyz);
    float soft = 0.25 + 0.35 * clamp(-along / max(light.w, 1e-6), 0.0, 3.0);
    float shadow = 1.0 - smoothstep(1.0 - soft, 1.0 + soft, off / max(light.w, 1e-6));
    return light.w > 0.0 && along < 0.0 ? 1.0 - 0.6 * shadow : 1.0;
}
