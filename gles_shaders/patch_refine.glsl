// Refines an approximate displacement by Gauss-Newton steps.
#include "patch_template.glsl"

// Takes at most `steps` Gauss-Newton steps from `best`, as long as they lower the cost and are not
// too short (kShortestStep). If `steps` is -1, `best` and `cost` stay unchanged. Otherwise, `cost`
// becomes the cost of the new `best`.
// The comparison of the patches needs all registers of a V3D (the GPU of a Raspberry Pi). Values
// that are needed after the comparison are therefore stored behind the template in templateWords[].
// The indices `none` and `later` are always 0, but the compiler does not know this. So it can
// neither keep the values in registers nor read them early.
void refine(vec2 known, LumaLevel l, ivec2 cell, int steps, inout vec2 best, inout float cost) {
    prepareSteps(known, cell);
    vec2 u = best;
    int none = 0;
    setMoment(11, best.x);
    setMoment(12, best.y);
    setMoment(13, cost);
    for (int k = 0; k <= steps; ++k) {
        setMoment(9, u.x);
        setMoment(10, u.y);
        Window w = windowAt(l, vec2(momentAt(14 + none), momentAt(15 + none)), u);
        Sums sums = Sums(0.0, 0.0, 0.0, vec2(0.0));
        int end = w.y + kRows;
        while (w.y < end) {
            Row b = nextRow(w, l);
            int r = w.y - end + kRows - 1;
            Row a = templateRow(r);
            add(sums, a, b);
            int later = sums.bb < 0.0 ? 1 : 0;
            sums.gb += vec2(product(slopeAcross(r, a), b), product(slopeDown(r + later), b));
        }
        Match m = matchOf(sums);
        none = w.y - end;
        u = vec2(momentAt(9 + none), momentAt(10 + none));
        if (k > 0 && !(m.cost < momentAt(13 + none))) break;
        setMoment(11, u.x);
        setMoment(12, u.y);
        setMoment(13, m.cost);
        if (!(dot(m.step, m.step) > kShortestStep)) break;
        u += m.step;
    }
    best = vec2(momentAt(11 + none), momentAt(12 + none));
    cost = momentAt(13 + none);
}
