// Tiles whose changes are too weak for one tile. Needs counts, noise, measured[], kWorkers and meet() of
// plan_dispatch.comp.

const int kBlock = 8;  // tiles
// Standard deviation of a tile's sum of squares over its mean, and how many of them are no accident.
const float kSpread = 0.27;
const float kSignificant = 5.0;
// Share of the noise that a change may always hide in: what 8-bit steps are off from white noise.
const float kLeast = 0.03;

shared vec4 sums[kWorkers];

/// Of a tile that did not surely change: 1, mean squares of pixels, of 2x2 means and of their twist.
vec4 energy(int tile) {
    return measured[2 * tile].x == 0.0 ? vec4(1.0, measured[2 * tile + 1].xyz) : vec4(0.0);
}

// In the same order whatever the number of workers that run at once.
vec4 energyOfAll(int worker) {
    vec4 sum = vec4(0.0);
    for (int i = worker; i < counts.x; i += kWorkers) sum += energy(i);
    sums[worker] = sum;
    meet();
    sum = vec4(0.0);
    for (int i = 0; i < kWorkers; ++i) sum += sums[i];
    return sum;
}

bool drifted(vec4 sum) {
    float room = max(kSignificant * kSpread * inversesqrt(max(sum.x, 1.0)), kLeast);
    return sum.z > (1.0 + room) * noise.x * sum.y + 0.01 * sum.x;
}

void markDrifted(int worker, ivec2 end, bool allDid) {
    ivec2 blocks = (end + kBlock - 1) / kBlock;
    for (int i = worker; i < blocks.x * blocks.y; i += kWorkers) {
        ivec2 first = kBlock * ivec2(i % blocks.x, i / blocks.x), last = min(first + kBlock, end);
        vec4 sum = vec4(0.0);
        for (int y = first.y; y < last.y; ++y)
            for (int x = first.x; x < last.x; ++x) sum += energy(y * counts.w + x);
        if (!allDid && !drifted(sum)) continue;
        for (int y = first.y; y < last.y; ++y)
            for (int x = first.x; x < last.x; ++x) measured[2 * (y * counts.w + x)].x = 1.0;
    }
}
