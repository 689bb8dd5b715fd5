// Comparison of 8x8 patches between two luma levels, invariant to offset and gain.
// A cell is 4x4 pixels; its patch has the same centre, so it starts 2 px left and above the cell.
// Needs: `uint luma[]` and the level functions of luma.glsl.

#include "pipeline/engine/params/patch.h"

struct Template {
    vec4 a0[8], a1[8];    // pixels, two vec4 a row
    vec4 gx0[8], gx1[8];  // central differences
    vec4 gy0[8], gy1[8];
    float mean;
    float variance;  // sum of squared deviations
    vec2 sumG;
    vec2 sumAG;  // of a (less its mean) times the gradient
    vec3 inverseHessian;  // xx, xy, yy
};

// Over the pixels of the patch: of the other picture, of its squares, of its product with a and with the
// gradients.
struct Sums {
    float b, bb, ab;
    vec2 gb;
};

struct Match {
    float cost;  // 0 = alike up to gain and offset, 1 = unrelated, 2 = inverted
    float gain;  // a is about gain * b + offset
    float covariance;
    float varianceB;
    vec2 descent;  // right-hand side of the Gauss-Newton step
};

// Twelve pixels of row y from word column wx (margin included) on, less the first shift / 8.
uvec3 fetchRow(LumaLevel l, int wx, int y, uint shift) {
    int at = l.offset + clamp(y, 0, l.height - 1) * l.pitch + wx;
    uvec3 w = uvec3(luma[at], luma[at + 1], luma[at + 2]);
    if (shift == 0u) return w;
    uint up = 32u - shift;
    return uvec3((w.x >> shift) | (w.y << up), (w.y >> shift) | (w.z << up), w.z >> shift);
}

// A row of the patch and its horizontal gradient.
struct TemplateRow {
    vec4 a0, a1, gx0, gx1;
};

TemplateRow templateRow(LumaLevel l, ivec2 cell, int r) {
    // From one pixel left of the patch on, which sits one byte into its word.
    uvec3 w = fetchRow(l, cell.x - 1 + kLumaMarginWords, 4 * cell.y - 2 + r, 8u);
    vec4 q0 = unpackPixels(w.x), q1 = unpackPixels(w.y), q2 = unpackPixels(w.z);
    return TemplateRow(vec4(q0.yzw, q1.x), vec4(q1.yzw, q2.x), 0.5 * (vec4(q0.zw, q1.xy) - q0),
                       0.5 * (vec4(q1.zw, q2.xy) - q1));
}

Template loadTemplate(LumaLevel l, ivec2 cell) {
    Template t;
    TemplateRow above = templateRow(l, cell, -1), row = templateRow(l, cell, 0);
    float sum = 0.0, sumSquares = 0.0;
    vec2 sumG = vec2(0.0), sumAG = vec2(0.0);
    vec3 h = vec3(0.0);
    for (int r = 0; r < 8; ++r) {
        TemplateRow below = templateRow(l, cell, r + 1);
        vec4 gy0 = 0.5 * (below.a0 - above.a0), gy1 = 0.5 * (below.a1 - above.a1);
        t.a0[r] = row.a0;
        t.a1[r] = row.a1;
        t.gx0[r] = row.gx0;
        t.gx1[r] = row.gx1;
        t.gy0[r] = gy0;
        t.gy1[r] = gy1;
        sum += dot(row.a0 + row.a1, vec4(1.0));
        sumSquares += dot(row.a0, row.a0) + dot(row.a1, row.a1);
        sumG += vec2(dot(row.gx0 + row.gx1, vec4(1.0)), dot(gy0 + gy1, vec4(1.0)));
        sumAG += vec2(dot(row.a0, row.gx0) + dot(row.a1, row.gx1), dot(row.a0, gy0) + dot(row.a1, gy1));
        h += vec3(dot(row.gx0, row.gx0) + dot(row.gx1, row.gx1), dot(row.gx0, gy0) + dot(row.gx1, gy1),
                  dot(gy0, gy0) + dot(gy1, gy1));
        above = row;
        row = below;
    }
    t.mean = sum / kPatchPixels;
    t.variance = max(sumSquares - sum * t.mean, 0.0);
    t.sumG = sumG;
    t.sumAG = sumAG - t.mean * sumG;
    h += vec3(kPatchDamping, 0.0, kPatchDamping) - vec3(sumG.x * sumG, sumG.y * sumG.y) / kPatchPixels;
    t.inverseHessian = vec3(h.z, -h.y, h.x) / max(h.x * h.z - h.y * h.y, 1.0);
    return t;
}

Match matchOf(Template t, Sums sums) {
    float mean = sums.b / kPatchPixels;
    Match m;
    m.varianceB = max(sums.bb - sums.b * mean, 0.0);
    m.covariance = sums.ab - t.mean * sums.b;
    m.gain = sqrt((t.variance + kPatchNoise) / (m.varianceB + kPatchNoise));
    m.descent = t.sumAG - m.gain * (sums.gb - mean * t.sumG);
    float energy = t.variance + m.gain * m.gain * m.varianceB;
    m.cost = max(energy - 2.0 * m.gain * m.covariance, 0.0) / (energy + kPatchNoise);
    return m;
}

// Row y of a patch, a share f of a pixel right of the shift.
void rowBetween(LumaLevel l, int wx, int y, uint shift, float f, out vec4 left, out vec4 right) {
    uvec3 w = fetchRow(l, wx, y, shift);
    vec4 q0 = unpackPixels(w.x), q1 = unpackPixels(w.y);
    left = q0 + (vec4(q0.yzw, q1.x) - q0) * f;
    right = q1 + (vec4(q1.yzw, float(w.z & 255u)) - q1) * f;
}

// The template against level l, displaced by u pixels. Positions outside are held at the border.
Match compare(Template t, LumaLevel l, ivec2 cell, vec2 u) {
    vec2 origin = clamp(vec2(4 * cell - 2) + u, vec2(-7.0), vec2(l.width - 2, l.height - 2));
    vec2 whole = floor(origin);
    vec2 f = origin - whole;
    ivec2 at = ivec2(whole);
    int wx = (at.x >> 2) + kLumaMarginWords;
    uint shift = uint(at.x & 3) * 8u;
    Sums sums = Sums(0.0, 0.0, 0.0, vec2(0.0));
    vec4 above0, above1;
    rowBetween(l, wx, at.y, shift, f.x, above0, above1);
    for (int r = 0; r < 8; ++r) {
        vec4 below0, below1;
        rowBetween(l, wx, at.y + r + 1, shift, f.x, below0, below1);
        vec4 b0 = above0 + (below0 - above0) * f.y, b1 = above1 + (below1 - above1) * f.y;
        sums.b += dot(b0 + b1, vec4(1.0));
        sums.bb += dot(b0, b0) + dot(b1, b1);
        sums.ab += dot(t.a0[r], b0) + dot(t.a1[r], b1);
        sums.gb += vec2(dot(t.gx0[r], b0) + dot(t.gx1[r], b1), dot(t.gy0[r], b0) + dot(t.gy1[r], b1));
        above0 = below0;
        above1 = below1;
    }
    return matchOf(t, sums);
}

// One Gauss-Newton step on the displacement, at most a pixel long.
vec2 stepOf(Template t, vec2 descent) {
    vec2 s = vec2(dot(t.inverseHessian.xy, descent), dot(t.inverseHessian.yz, descent));
    float n = length(s);
    return n > 1.0 ? s / n : s;
}
