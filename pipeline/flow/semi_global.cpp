#include "pipeline/flow/semi_global.h"

#include "pipeline/flow/byte_lanes.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr int kLanes = SemiGlobal::kLabels;
// Beside the labels of a pixel: reads of up to a whole window off find this, which never wins.
constexpr int kMargin = 32;
constexpr std::uint8_t kNever = 200;
constexpr int kFarthestShift = kLanes;

int strideOf(int vectors) {
    return kLanes * vectors + 2 * kMargin;
}

/// One step of a path: `from` = the last pixel's path costs, `shift` = difference of the windows.
/// Path costs are kept less their least, so that they are bounded and the sums comparable.
template <int kVectors>
inline void step(const std::uint8_t* from, int shift, Bytes16 stepPenalty, Bytes16 jumpPenalty,
                 const std::uint8_t* cost, std::uint8_t* to, int vectors) {
    const int n = kVectors > 0 ? kVectors : vectors;
    const std::uint8_t* at = from + kMargin + std::clamp(shift, -kFarthestShift, kFarthestShift);
    Bytes16 least = spread(255), sum{};
    for (int v = 0; v < n; ++v) {
        const Bytes16 same = loadBytes(at + kLanes * v);
        const Bytes16 beside =
            lesser(loadBytes(at + kLanes * v - 1), loadBytes(at + kLanes * v + 1)) + stepPenalty;
        sum = loadBytes(cost + kLanes * v) + lesser(lesser(same, beside), jumpPenalty);
        least = lesser(least, sum);
        if constexpr (kVectors != 1) storeBytes(to + kMargin + kLanes * v, sum);
    }
    least = leastOf(least);
    if constexpr (kVectors == 1) {
        storeBytes(to + kMargin, sum - least);
        return;
    }
    for (int v = 0; v < n; ++v) {
        std::uint8_t* lane = to + kMargin + kLanes * v;
        storeBytes(lane, loadBytes(lane) - least);
    }
}

using Sums8 = std::int16_t __attribute__((vector_size(16)));

Sums8 lesser(Sums8 a, Sums8 b) {
    return a < b ? a : b;
}

/// The least of the sums of sixteen pairs of bytes, times sixteen, plus its place.
int leastSum(Bytes16 a, Bytes16 b) {
    const auto even = [](Bytes16 v) { return reinterpret_cast<Sums8>(v) & 0xFF; };
    const auto odd = [](Bytes16 v) { return reinterpret_cast<Sums8>(v) >> 8 & 0xFF; };
    const Sums8 first{0, 2, 4, 6, 8, 10, 12, 14};
    Sums8 v = lesser((even(a) + even(b)) * 16 + first, (odd(a) + odd(b)) * 16 + first + 1);
    v = lesser(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3));
    v = lesser(v, __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5));
    return std::min(v[0], v[1]);
}

/// Best of the summed costs, with the vertex of the two straight lines through it and its
/// neighbours (a parabola would lock to whole labels on such costs).
float bestOf(const std::uint8_t* sums, const std::uint8_t* path, int vectors) {
    static_assert(kLanes == 16);
    int best = 0, least = 1 << 30;
    for (int v = 0; v < vectors; ++v) {
        const int found = leastSum(loadBytes(sums + kLanes * v), loadBytes(path + kLanes * v));
        if (found / kLanes >= least) continue;
        least = found / kLanes;
        best = kLanes * v + found % kLanes;
    }
    if (best == 0 || best + 1 == kLanes * vectors) return static_cast<float>(best);
    const int left = sums[best - 1] + path[best - 1], right = sums[best + 1] + path[best + 1];
    const int rise = std::max(left, right) - least;
    if (rise <= 0) return static_cast<float>(best);
    return static_cast<float>(best) +
           0.5F * static_cast<float>(left - right) / static_cast<float>(rise);
}

}  // namespace

struct SemiGlobal::Task {
    const LumaImage& guide;
    const std::vector<std::int16_t>& base;
    int vectors;
    Bytes16 step;
    const CostRow& costs;
    std::vector<float>& out;

    [[nodiscard]] std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * guide.size.width + x;
    }
    [[nodiscard]] std::size_t labels() const { return static_cast<std::size_t>(kLanes) * vectors; }
};

SemiGlobal::SemiGlobal(std::size_t vectors) : costs_(kLanes * vectors), sums_(kLanes * vectors) {}

void SemiGlobal::run(const LumaImage& guide, const std::vector<std::int16_t>& base, int vectors,
                     const Smoothness& smoothness, const CostRow& costs, Workers& workers,
                     std::vector<float>& out) {
    for (int d = 0; d < 256; ++d) {
        const double edge = std::max(0.0, d - smoothness.noise);
        const double jump = std::max<double>(smoothness.step + 3, smoothness.jump * 8 / (8 + edge));
        storeBytes(jump_.data() + 16UL * d, spread(static_cast<std::uint8_t>(jump)));
    }
    const Task task{guide, base, vectors, spread(static_cast<std::uint8_t>(smoothness.step)),
                    costs, out};
    workers.forRange(guide.size.height, 4, [&](int first, int last) {
        std::vector<std::uint8_t> scratch(2UL * strideOf(vectors), kNever);
        for (int y = first; y < last; ++y)
            alongRow(task, y, scratch.data());
    });
    workers.forRange(guide.size.width, 32,
                     [&](int first, int last) { alongColumns(task, first, last); });
}

void SemiGlobal::alongRow(const Task& task, int y, std::uint8_t* scratch) {
    const int width = task.guide.size.width;
    const std::size_t labels = task.labels();
    const std::uint8_t* luma = task.guide.row(y);
    const std::int16_t* base = task.base.data() + task.pixel(0, y);
    std::uint8_t* costs = costs_.data() + task.pixel(0, y) * labels;
    std::uint8_t* sums = sums_.data() + task.pixel(0, y) * labels;
    task.costs(y, costs);
    std::uint8_t* last = scratch;
    std::uint8_t* now = scratch + strideOf(task.vectors);
    const auto jumpOf = [&](int a, int b) {
        return loadBytes(jump_.data() + 16UL * std::abs(a - b));
    };
    const auto advance = [&](int x, int from) {
        const Bytes16 jump = jumpOf(luma[x], luma[from]);
        const std::uint8_t* cost = costs + x * labels;
        if (task.vectors == 1)
            step<1>(last, base[x] - base[from], task.step, jump, cost, now, 1);
        else
            step<0>(last, base[x] - base[from], task.step, jump, cost, now, task.vectors);
        std::swap(last, now);
    };
    std::fill_n(last + kMargin, labels, std::uint8_t{0});
    for (int x = 0; x < width; ++x) {
        advance(x, std::max(x - 1, 0));
        std::copy_n(last + kMargin, labels, sums + x * labels);
    }
    std::fill_n(last + kMargin, labels, std::uint8_t{0});
    for (int x = width - 1; x >= 0; --x) {
        advance(x, std::min(x + 1, width - 1));
        for (int v = 0; v < task.vectors; ++v) {
            std::uint8_t* sum = sums + x * labels + kLanes * v;
            storeBytes(sum, loadBytes(sum) + loadBytes(last + kMargin + kLanes * v));
        }
    }
}

void SemiGlobal::alongColumns(const Task& task, int x0, int x1) {
    const int height = task.guide.size.height;
    const std::size_t labels = task.labels();
    const int stride = strideOf(task.vectors);
    std::vector<std::uint8_t> paths(static_cast<std::size_t>(x1 - x0) * stride, kNever);
    std::vector<std::uint8_t> fresh(stride, kNever);
    const auto restart = [&] {
        for (int x = x0; x < x1; ++x)
            std::fill_n(paths.begin() + static_cast<std::ptrdiff_t>(x - x0) * stride + kMargin,
                        labels, std::uint8_t{0});
    };
    const auto jumpOf = [&](int a, int b) {
        return loadBytes(jump_.data() + 16UL * std::abs(a - b));
    };
    const auto advance = [&](int x, int y, int from) {
        const std::size_t i = task.pixel(x, y), j = task.pixel(x, from);
        const Bytes16 jump = jumpOf(task.guide.pixels[i], task.guide.pixels[j]);
        std::uint8_t* path = paths.data() + static_cast<std::size_t>(x - x0) * stride;
        const std::uint8_t* cost = costs_.data() + i * labels;
        const int shift = task.base[i] - task.base[j];
        if (task.vectors == 1) {
            step<1>(path, shift, task.step, jump, cost, path, 1);
        } else {
            step<0>(path, shift, task.step, jump, cost, fresh.data(), task.vectors);
            std::copy_n(fresh.data() + kMargin, labels, path + kMargin);
        }
        return path + kMargin;
    };
    restart();
    for (int y = 0; y < height; ++y) {
        for (int x = x0; x < x1; ++x) {
            const std::uint8_t* path = advance(x, y, std::max(y - 1, 0));
            std::uint8_t* sum = sums_.data() + task.pixel(x, y) * labels;
            for (int v = 0; v < task.vectors; ++v)
                storeBytes(sum + kLanes * v,
                           loadBytes(sum + kLanes * v) + loadBytes(path + kLanes * v));
        }
    }
    restart();
    for (int y = height - 1; y >= 0; --y) {
        for (int x = x0; x < x1; ++x) {
            const std::uint8_t* path = advance(x, y, std::min(y + 1, height - 1));
            const std::size_t i = task.pixel(x, y);
            task.out[i] = static_cast<float>(task.base[i]) +
                          bestOf(sums_.data() + i * labels, path, task.vectors);
        }
    }
}

}  // namespace mfar
