// Reads patches of 8x8 pixels of a luma pyramid level, row by row. A cell's patch is centred on
// the cell, except at the border; see patch_start.glsl. Needs `uint luma[]` and the functions of
// luma.glsl.
#include "patch_start.glsl"

#include "pipeline/engine/params/patch.h"

const int kRows = 8;

struct Row {
    vec4 left, right;
};

float sumOf(Row a) {
    return dot(a.left + a.right, vec4(1.0));
}
float product(Row a, Row b) {
    return dot(a.left, b.left) + dot(a.right, b.right);
}
// Returns the index in luma[] of a word in row y of a pyramid level. `column` is counted in words
// from the level's left edge, without the margin.
int wordAt(LumaLevel l, int column, int y) {
    return l.offset + clamp(y, 0, l.height - 1) * l.pitch + kLumaMarginWords + column;
}
uvec3 fetchWords(int at) {
    return uvec3(luma[at], luma[at + 1], luma[at + 2]);
}
ivec2 sizeOf(LumaLevel l) {
    return ivec2(l.width, l.height);
}
// Discards the first `shift` bits of three words.
uvec3 shifted(uvec3 words, uint shift) {
    // A shift by 32 is undefined, so the shift by 32 - shift is done in two parts, 1 and `up`.
    uint up = 31u - shift;
    return uvec3((words.x >> shift) | (words.y << 1 << up), (words.y >> shift) | (words.z << 1 << up),
                 words.z >> shift);
}

// State of nextRow(), which reads a patch row by row. The patch's position may be between pixels.
struct Window {
    // first: index in luma[] of the patch's first column of words, in row 0 of the pyramid level.
    // y: row of `above`.
    int first, y;
    uint shift;     // number of bits in the first word before the patch's first pixel
    vec2 f;         // fractional part of the patch's position (x, y) [px]
    uvec3 above;    // packed pixels of row y
};

uvec3 fetchPixels(LumaLevel l, Window w) {
    return shifted(fetchWords(w.first + clamp(w.y, 0, l.height - 1) * l.pitch), w.shift);
}

// Starts reading a patch, displaced by u pixels. `start` is its first pixel without displacement.
// The patch's position is limited so that the patch overlaps the pyramid level. Pixels of the patch
// outside the level repeat the level's border.
Window windowAt(LumaLevel l, vec2 start, vec2 u) {
    vec2 origin = clamp(start + u, vec2(-7.0), vec2(l.width - 2, l.height - 2));
    vec2 whole = floor(origin);
    ivec2 at = ivec2(whole);
    Window w = Window(wordAt(l, at.x >> 2, 0), at.y, uint(at.x & 3) * 8u, origin - whole, uvec3(0u));
    w.above = fetchPixels(l, w);
    return w;
}

// Reads the next row of the patch, interpolated between pixels. Interpolates along y first, so that
// `above` can stay packed in words.
Row nextRow(inout Window w, LumaLevel l) {
    ++w.y;
    uvec3 below = fetchPixels(l, w);
    vec4 p0 = unpackPixels(w.above.x), p1 = unpackPixels(w.above.y);
    vec4 q0 = p0 + (unpackPixels(below.x) - p0) * w.f.y, q1 = p1 + (unpackPixels(below.y) - p1) * w.f.y;
    float p2 = float(w.above.z & 255u), q2 = p2 + (float(below.z & 255u) - p2) * w.f.y;
    w.above = below;
    return Row(q0 + (vec4(q0.yzw, q1.x) - q0) * w.f.x, q1 + (vec4(q1.yzw, q2) - q1) * w.f.x);
}

// Compares the cell's patch in pyramid level a with the patch in pyramid level b that is displaced
// by u pixels. Returns their covariance, the variance in a and the variance in b, each as a sum
// over the pixels.
vec3 spreadOf(LumaLevel a, LumaLevel b, ivec2 cell, vec2 u) {
    ivec2 start = patchStart(cell, sizeOf(a));
    Window w = windowAt(b, vec2(start), u);
    int first = wordAt(a, start.x >> 2, 0);
    uint shift = uint(start.x & 3) * 8u;
    vec2 sum = vec2(0.0);
    vec3 squares = vec3(0.0);
    for (int r = 0; r < kRows; ++r) {
        uvec3 words = shifted(fetchWords(first + clamp(start.y + r, 0, a.height - 1) * a.pitch), shift);
        Row pa = Row(unpackPixels(words.x), unpackPixels(words.y)), pb = nextRow(w, b);
        sum += vec2(sumOf(pa), sumOf(pb));
        squares += vec3(product(pa, pb), product(pa, pa), product(pb, pb));
    }
    vec3 spread = squares - vec3(sum.x * sum.y, sum * sum) / kPatchPixels;
    return vec3(spread.x, max(spread.yz, vec2(0.0)));
}
