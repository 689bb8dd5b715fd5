// What both ways to triangulate share: from the flow of a pixel to its parallax, and what is stored.
// A parallax of 0.01 degrees is right to 1e-6 in single precision: what is large and cancels is split into a
// head on a grid of 2^-12 and a tail. Products of two heads, and their sums below 1, are exact, in any order.
#include "undistort_step.glsl"

const float kUnknownSigma = 1e9;    // [1/m]
const float kLargestRho = 1e6;      // [1/m]
const float kNearPlane = 0.05;      // least z in a's orientation of b's ray (x, y, 1)
const float kNoAngle = 1e-9;        // normalised units: rays are parallel, a pixel is its own epipole

layout(local_size_x = 16, local_size_y = 4) in;
layout(std140, binding = 0) uniform Params {
    ivec4 sizes;         // width, height of view a and of view b [px]
    vec4 lensB;          // fx, fy [px], k1, k2
    vec4 tangentialB;    // p1, p2, k3, -
    vec4 turnHead[3];    // rows of R_a_b - I, on the grid
    vec4 turnTail[3];
    vec4 baselineHead;   // unit vector of R_a_b t_b_a, on the grid; length [m]
    vec4 baselineTail;
    vec4 tune;           // flow error, focal length of b [px], longest line between the rays [m], -
};
// Textures: software renderers load a buffer word by word.
layout(binding = 0) uniform highp sampler2D flow;   // [px], of every pixel of view a
layout(binding = 1) uniform highp sampler2D raysA;  // normalised rays of the pixels: head, tail
layout(binding = 2) uniform highp sampler2D raysB;
layout(std430, binding = 0) writeonly buffer Points {
    vec4 points[];  // inverse depth, sigma [1/m], epipolar residual [px], ray distance [m]
};

// u and e in normalised coordinates of a, the rotation removed: with a baseline of length 1,
// u = rho e / (1 + rho b.z).
struct Parallax {
    vec2 ray;    // of view a
    vec2 u;      // residual flow
    vec2 e;      // b.xy - ray b.z
    vec3 b;      // unit baseline, zero without one
};

// The residual flow between a ray of a and b's ray at a pixel plus a fraction of a pixel.
bool residualFlow(vec4 a, vec4 b, vec2 fraction, out vec2 u) {
    vec2 head, tail;
    undistortStep(vec3(lensB.zw, tangentialB.z), tangentialB.xy, b.xy + b.zw, fraction / lensB.xy, head, tail);
    head += b.xy;
    tail += b.zw;
    vec3 head3 = vec3(head, 1.0);
    vec3 ray3 = vec3(head + tail, 1.0);
    vec3 turned, rest;
    for (int i = 0; i < 3; ++i) {
        turned[i] = dot(turnHead[i].xyz, head3);
        rest[i] = dot(turnTail[i].xyz, ray3) + dot(turnHead[i].xy, tail);
    }
    float z = 1.0 + turned.z + rest.z;
    float coarse = onGrid(turned.zz).x;
    vec2 exact = (head - a.xy) + turned.xy - a.xy * coarse;
    vec2 rounded = (tail - a.zw) + rest.xy - a.xy * ((turned.z - coarse) + rest.z) - a.zw * (turned.z + rest.z);
    u = (exact + rounded) / z;
    return z > kNearPlane;
}

// False where the flow is not finite or leads out of view b.
bool parallaxAt(ivec2 p, out Parallax s) {
    vec2 f = texelFetch(flow, p, 0).xy;
    vec2 q = vec2(p) + f;
    vec2 end = vec2(sizes.zw) - 0.5;
    if (!(q.x >= -0.5 && q.y >= -0.5 && q.x <= end.x && q.y <= end.y)) return false;
    vec2 whole = floor(f + 0.5);
    ivec2 pixel = clamp(p + ivec2(whole), ivec2(0), sizes.zw - 1);
    vec4 a = texelFetch(raysA, p, 0);
    s.ray = a.xy + a.zw;
    s.b = baselineHead.xyz + baselineTail.xyz;
    s.e = (baselineHead.xy - a.xy * baselineHead.z) +
          (baselineTail.xy - a.xy * baselineTail.z - a.zw * s.b.z);
    vec2 fraction = (f - whole) + vec2(p + ivec2(whole) - pixel);
    return residualFlow(a, texelFetch(raysB, pixel, 0), fraction, s.u);
}

float crossOf(vec2 a, vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// |(ray, 1) x (v, 0)|^2
float squaredNormal(vec2 ray, vec2 v) {
    float z = crossOf(ray, v);
    return dot(v, v) + z * z;
}

// [px], as an undistorted view with b's focal length, oriented as a, would show it; all of the flow where there
// is no epipolar line.
float epipolarResidual(Parallax s) {
    float along = length(s.e);
    return tune.y * (along > kNoAngle ? crossOf(s.e, s.u) / along : length(s.u));
}

// |b . n| / |n| with n = r x (u, 0), the normal of both rays; of parallel rays |b x r| / |r|.
float rayDistance(Parallax s) {
    float n2 = squaredNormal(s.ray, s.u);
    float square = n2 > kNoAngle * kNoAngle ? crossOf(s.u, s.e) * crossOf(s.u, s.e) / n2
                                            : squaredNormal(s.ray, s.e) / (1.0 + dot(s.ray, s.ray));
    return baselineHead.w * sqrt(square);
}

// Of the flow form, to first order; not smaller for any other way to the same depth.
float sigmaOf(Parallax s) {
    float ee = dot(s.e, s.e);
    float d = ee - s.b.z * dot(s.u, s.e);
    float sigma = tune.x / tune.y * sqrt(ee) * ee / (d * d) / baselineHead.w;
    return sigma < kUnknownSigma ? sigma : kUnknownSigma;
}

// `rho`: inverse depth for a baseline of length 1; anything that is not one is unknown.
void store(ivec2 p, Parallax s, float rho) {
    float distance = rayDistance(s);
    rho /= baselineHead.w;
    bool known = rho > 0.0 && rho < kLargestRho && distance <= tune.z;
    points[p.y * sizes.x + p.x] =
        vec4(known ? rho : 0.0, known ? sigmaOf(s) : kUnknownSigma, epipolarResidual(s), distance);
}

void storeNothing(ivec2 p) {
    points[p.y * sizes.x + p.x] = vec4(0.0, kUnknownSigma, 0.0, 0.0);
}
