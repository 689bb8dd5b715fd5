// A step on the sensor, given beside a known ray, through the lens model of camera.glsl; in two parts, so that
// single precision loses nothing: a head on a grid and a tail.
const float kGrid = 4096.0;  // steps of a head a unit

vec2 onGrid(vec2 v) {
    return floor(v * kGrid + 0.5) * (1.0 / kGrid);
}

// Solves distort(r + w) - distort(r) = g for w = head + tail of up to a pixel, by Newton steps with the Jacobian
// at the ray; the difference is taken term by term, so that nothing cancels. k: radial, t: tangential
// coefficients. Zero where the lens model folds over.
void undistortStep(vec3 k, vec2 t, vec2 r, vec2 g, out vec2 head, out vec2 tail) {
    head = tail = vec2(0.0);
    float r2 = dot(r, r);
    float bend = r2 * (k.x + r2 * (k.y + r2 * k.z));
    float slope = 2.0 * (k.x + r2 * (2.0 * k.y + 3.0 * r2 * k.z));
    float across = slope * r.x * r.y + 2.0 * dot(t, r);
    float jx = 1.0 + bend + slope * r.x * r.x + 2.0 * t.x * r.y + 6.0 * t.y * r.x;
    float jy = 1.0 + bend + slope * r.y * r.y + 6.0 * t.x * r.y + 2.0 * t.y * r.x;
    float det = jx * jy - across * across;
    if (!(det > 0.05)) return;
    for (int i = 0; i < 3; ++i) {
        vec2 w = head + tail;
        vec2 squares = w * (2.0 * r + w);
        float d = squares.x + squares.y;
        float s2 = r2 + d;
        float change = d * (k.x + k.y * (s2 + r2) + k.z * (s2 * s2 + s2 * r2 + r2 * r2));
        float product = r.x * w.y + r.y * w.x + w.x * w.y;
        vec2 bent = w * (bend + change) + r * change + 2.0 * t * product + t.yx * (d + 2.0 * squares);
        vec2 off = ((g - head) - tail) - bent;
        tail += vec2(jy * off.x - across * off.y, jx * off.y - across * off.x) / det;
        vec2 whole = onGrid(tail);
        head += whole;
        tail -= whole;
    }
}
