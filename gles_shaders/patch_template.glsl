// An 8x8 patch (the template) that is searched in a pyramid level of the other picture. The cost
// does not depend on an offset between both pictures' luma, and hardly on a gain.
#include "patch.glsl"

// The template. Each of the rows -1 to kRows has three words: two with its eight pixels, and one
// with the pixels to the left and right of these. Nine floats follow: mean, variance (sum of
// squared deviations), sum of the gradient (x, y), sum of the gradient times the deviation of the
// pixel from the mean (x, y), inverse Hessian (xx, xy, yy). The next five floats belong to
// patch_refine.glsl. Two more are the position (x, y) of the patch's first pixel without
// displacement; a comparison has no free registers for them. The last words are not used.
// A board's GPU lacks registers for both the template and a comparison. Indexing by variables makes
// the compiler keep the array in memory; Mali's compiler does so only for more than 64 words. Here
// and in the files that include this file, the compiler does not know the length of loops over the
// rows. So it does not unroll the loops and keeps only one row in registers.
uint templateWords[72];

// Sums over the pixels of a patch: of b, of b^2, of b times the template's pixel, and of b times
// twice the template's gradient. b is a pixel of the searched picture.
struct Sums {
    float b, bb, ab;
    vec2 gb;
};

struct Match {
    float cost;
    vec2 step;  // Gauss-Newton step of the displacement, at most one pixel long
};

// Returns row r of the template; r is in [-1, kRows].
Row templateRow(int r) {
    int at = 3 * r + 3;
    return Row(unpackPixels(templateWords[at]), unpackPixels(templateWords[at + 1]));
}
// Twice the template's gradient along x (slopeAcross) and along y (slopeDown).
Row slopeAcross(int r, Row a) {
    uint word = templateWords[3 * r + 5];
    float before = float((word >> 8) & 255u), after = float((word >> 16) & 255u);
    return Row(vec4(a.left.yzw, a.right.x) - vec4(before, a.left.xyz),
               vec4(a.right.yzw, after) - vec4(a.left.w, a.right.xyz));
}
Row slopeDown(int r) {
    Row above = templateRow(r - 1), below = templateRow(r + 1);
    return Row(below.left - above.left, below.right - above.right);
}

float momentAt(int i) {
    return uintBitsToFloat(templateWords[3 * kRows + 6 + i]);
}
void setMoment(int i, float value) {
    templateWords[3 * kRows + 6 + i] = floatBitsToUint(value);
}

// Stores the rows, mean, variance and position of the cell's patch in templateWords[]. Returns mean
// and variance.
vec2 loadTemplate(LumaLevel l, ivec2 cell) {
    ivec2 start = patchStart(cell, sizeOf(l));
    uint shift = uint(start.x & 3) * 8u, toLeft = (shift + 24u) & 31u;
    int first = wordAt(l, start.x >> 2, 0), left = shift == 0u ? -1 : 0;
    float sum = 0.0, sumSquares = 0.0;
    for (int y = start.y - 1, end = y + kRows + 2; y < end; ++y) {
        int r = y - end + kRows + 1, at = 3 * r + 3, from = first + clamp(y, 0, l.height - 1) * l.pitch;
        uvec3 row = shifted(fetchWords(from), shift);
        uint before = luma[from + left] >> toLeft;
        templateWords[at] = row.x;
        templateWords[at + 1] = row.y;
        templateWords[at + 2] = ((before & 255u) << 8) | ((row.z & 255u) << 16);
        if (r < 0 || r == kRows) continue;
        Row a = Row(unpackPixels(row.x), unpackPixels(row.y));
        sum += sumOf(a);
        sumSquares += product(a, a);
    }
    float mean = sum / kPatchPixels, variance = max(sumSquares - sum * mean, 0.0);
    setMoment(0, mean);
    setMoment(1, variance);
    setMoment(14, float(start.x));
    setMoment(15, float(start.y));
    return vec2(mean, variance);
}

// Stores in templateWords[] those floats of the template that only a Gauss-Newton step needs: the
// sums with the gradient and the inverse Hessian. `known` is the template's mean and variance.
void prepareSteps(vec2 known, ivec2 cell) {
    vec2 sum = vec2(0.0), sumA = vec2(0.0);
    vec3 h = vec3(0.0);
    int r = 0, y = cell.y, end = y + kRows;
    for (; y < end; ++r, ++y) {
        Row a = templateRow(r), gx = slopeAcross(r, a), gy = slopeDown(r);
        sum += vec2(sumOf(gx), sumOf(gy));
        sumA += vec2(product(a, gx), product(a, gy));
        h += vec3(product(gx, gx), product(gx, gy), product(gy, gy));
    }
    sum *= 0.5;
    sumA = 0.5 * sumA - known.x * sum;
    h = 0.25 * h + vec3(kPatchDamping, 0.0, kPatchDamping) - vec3(sum.x * sum, sum.y * sum.y) / kPatchPixels;
    h = vec3(h.z, -h.y, h.x) / max(h.x * h.z - h.y * h.y, 1.0);
    float moments[7] = float[](sum.x, sum.y, sumA.x, sumA.y, h.x, h.y, h.z);
    for (int i = 0; i < 7; ++i) templateWords[3 * r + 8 + i] = floatBitsToUint(moments[i]);
}

void add(inout Sums sums, Row a, Row b) {
    sums.b += sumOf(b);
    sums.bb += product(b, b);
    sums.ab += product(a, b);
}

// Returns the cost: 0 if the patches are equal up to gain and offset, 1 if they are unrelated, 2 if
// one is the negative of the other. `known` is the template's mean and variance. A pixel of the
// template is about gain * b + offset, where b is the pixel of the searched picture.
float costOf(vec2 known, Sums sums, out float gain) {
    float mean = sums.b / kPatchPixels;
    float variance = max(sums.bb - sums.b * mean, 0.0);
    gain = sqrt((known.y + kPatchNoise) / (variance + kPatchNoise));
    float energy = known.y + gain * gain * variance;
    return max(energy - 2.0 * gain * (sums.ab - known.x * sums.b), 0.0) / (energy + kPatchNoise);
}

Match matchOf(Sums sums) {
    float gain;
    Match m;
    m.cost = costOf(vec2(momentAt(0), momentAt(1)), sums, gain);
    vec2 descent = vec2(momentAt(4), momentAt(5)) -
                   gain * (0.5 * sums.gb - sums.b / kPatchPixels * vec2(momentAt(2), momentAt(3)));
    m.step = vec2(momentAt(6) * descent.x + momentAt(7) * descent.y,
                  momentAt(7) * descent.x + momentAt(8) * descent.y);
    m.step /= max(length(m.step), 1.0);
    return m;
}

float costAt(vec2 known, LumaLevel l, ivec2 cell, vec2 u) {
    Window w = windowAt(l, vec2(momentAt(14), momentAt(15)), u);
    Sums sums = Sums(0.0, 0.0, 0.0, vec2(0.0));
    int end = w.y + kRows;
    while (w.y < end) {
        Row b = nextRow(w, l);
        add(sums, templateRow(w.y - end + kRows - 1), b);
    }
    float gain;
    return costOf(known, sums, gain);
}
