#include "pipeline/epipolar/semi_global.h"

#include "pipeline/epipolar/byte_lanes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mfar {
namespace {

constexpr int kLanes = SemiGlobal::kLabels;
// Beside the labels of a pixel: a label that the last pixel's window has not finds this, which
// never wins.
constexpr std::uint8_t kNever = 200;

/// Such bytes on either side of a pixel's labels: room for a window that has none of the last's,
/// nor a neighbour of them.
constexpr int marginOf(int vectors) {
    return kLanes * (vectors + 1);
}

constexpr int strideOf(int vectors) {
    return kLanes * vectors + 2 * marginOf(vectors);
}

/// One step of a path: `from` = the last pixel's path costs, `shift` = difference of the windows.
/// Path costs are kept less their least, so that they are bounded and the sums comparable.
template <int Vectors>
inline void step(const std::uint8_t* from, int shift, Bytes16 stepPenalty, Bytes16 jumpPenalty,
                 const std::uint8_t* cost, std::uint8_t* to, int vectors) {
    const int n = Vectors > 0 ? Vectors : vectors;
    const int apart = kLanes * n + 1;
    const std::uint8_t* at = from + std::clamp(shift, -apart, apart);
    Bytes16 least = spread(255), sum{};
    for (int v = 0; v < n; ++v) {
        const Bytes16 same = loadBytes(at + kLanes * v);
        const Bytes16 beside =
            lesser(loadBytes(at + kLanes * v - 1), loadBytes(at + kLanes * v + 1)) + stepPenalty;
        sum = loadBytes(cost + kLanes * v) + lesser(lesser(same, beside), jumpPenalty);
        least = lesser(least, sum);
        if constexpr (Vectors != 1) storeBytes(to + kLanes * v, sum);
    }
    least = leastOf(least);
    if constexpr (Vectors == 1) {
        storeBytes(to, sum - least);
        return;
    }
    for (int v = 0; v < n; ++v) {
        std::uint8_t* lane = to + kLanes * v;
        storeBytes(lane, loadBytes(lane) - least);
    }
}

/// The penalties of jumps by difference of luma are in `table`, a vector each.
inline Bytes16 jumpOf(const std::array<std::uint8_t, 256UL * 16>& table, int a, int b) {
    return loadBytes(table.data() + 16UL * std::abs(a - b));
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

Valley valleyOf(const std::uint8_t* sums, const std::uint8_t* path, int vectors) {
    static_assert(kLanes == 16);
    int best = 0, least = 1 << 30;
    for (int v = 0; v < vectors; ++v) {
        const int found = leastSum(loadBytes(sums + kLanes * v), loadBytes(path + kLanes * v));
        if (found / kLanes >= least) continue;
        least = found / kLanes;
        best = kLanes * v + found % kLanes;
    }
    const auto riseOf = [&](int label) {
        if (label < 0 || label >= kLanes * vectors) return Valley::kUnknown;
        return static_cast<std::uint8_t>(
            std::min(sums[label] + path[label] - least, Valley::kUnknown - 1));
    };
    return {best, {riseOf(best - 2), riseOf(best - 1), riseOf(best + 1), riseOf(best + 2)}};
}

}  // namespace

float vertexOf(const Valley& valley) {
    const int left = valley.rise[1], right = valley.rise[2], rise = std::max(left, right);
    const auto label = static_cast<float>(valley.label);
    if (rise == 0 || rise == Valley::kUnknown) return label;
    return label + 0.5F * static_cast<float>(left - right) / static_cast<float>(rise);
}

struct SemiGlobal::Task {
    const LumaImage& guide;
    const std::vector<std::int16_t>& base;
    int vectors;
    Bytes16 step;
    const CostRow& costs;
    std::span<Valley> out;

    [[nodiscard]] std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * guide.size.width + x;
    }
    [[nodiscard]] std::size_t labels() const { return static_cast<std::size_t>(kLanes) * vectors; }
};

SemiGlobal::SemiGlobal(std::size_t vectors) : costs_(kLanes * vectors), sums_(kLanes * vectors) {}

void SemiGlobal::run(const LumaImage& guide, const std::vector<std::int16_t>& base, int vectors,
                     const Smoothness& smoothness, const CostRow& costs, Workers& workers,
                     std::span<Valley> out) {
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
    std::uint8_t* last = scratch + marginOf(task.vectors);
    std::uint8_t* now = last + strideOf(task.vectors);
    const auto advance = [&](int x, int from) {
        const Bytes16 jump = jumpOf(jump_, luma[x], luma[from]);
        const std::uint8_t* cost = costs + x * labels;
        if (task.vectors == 1)
            step<1>(last, base[x] - base[from], task.step, jump, cost, now, 1);
        else
            step<0>(last, base[x] - base[from], task.step, jump, cost, now, task.vectors);
        std::swap(last, now);
    };
    std::fill_n(last, labels, std::uint8_t{0});
    for (int x = 0; x < width; ++x) {
        advance(x, std::max(x - 1, 0));
        std::copy_n(last, labels, sums + x * labels);
    }
    std::fill_n(last, labels, std::uint8_t{0});
    for (int x = width - 1; x >= 0; --x) {
        advance(x, std::min(x + 1, width - 1));
        for (int v = 0; v < task.vectors; ++v) {
            std::uint8_t* sum = sums + x * labels + kLanes * v;
            storeBytes(sum, loadBytes(sum) + loadBytes(last + kLanes * v));
        }
    }
}

/// The path costs of columns [x0, x1), which all go down or up together.
class SemiGlobal::Columns {
public:
    Columns(const SemiGlobal& matcher, const Task& task, int x0, int x1)
        : matcher_(matcher), task_(task), x0_(x0), x1_(x1),
          paths_(static_cast<std::size_t>(x1 - x0) * strideOf(task.vectors), kNever),
          fresh_(strideOf(task.vectors), kNever) {}

    void restart() {
        for (int x = x0_; x < x1_; ++x)
            std::fill_n(pathOf(x), task_.labels(), std::uint8_t{0});
    }

    /// The path costs of pixel (x, y), come from row `from`.
    const std::uint8_t* advance(int x, int y, int from) {
        const std::size_t i = task_.pixel(x, y), j = task_.pixel(x, from);
        const auto& luma = task_.guide.pixels;
        const Bytes16 jump = jumpOf(matcher_.jump_, luma[i], luma[j]);
        std::uint8_t* path = pathOf(x);
        const std::uint8_t* cost = matcher_.costs_.data() + i * task_.labels();
        const int shift = task_.base[i] - task_.base[j];
        if (task_.vectors == 1) {
            step<1>(path, shift, task_.step, jump, cost, path, 1);
        } else {
            std::uint8_t* fresh = fresh_.data() + marginOf(task_.vectors);
            step<0>(path, shift, task_.step, jump, cost, fresh, task_.vectors);
            std::copy_n(fresh, task_.labels(), path);
        }
        return path;
    }

private:
    std::uint8_t* pathOf(int x) {
        return paths_.data() + static_cast<std::size_t>(x - x0_) * strideOf(task_.vectors) +
               marginOf(task_.vectors);
    }

    const SemiGlobal& matcher_;
    const Task& task_;
    int x0_, x1_;
    std::vector<std::uint8_t> paths_, fresh_;
};

void SemiGlobal::alongColumns(const Task& task, int x0, int x1) {
    const int height = task.guide.size.height;
    const std::size_t labels = task.labels();
    Columns columns(*this, task, x0, x1);
    columns.restart();
    for (int y = 0; y < height; ++y) {
        for (int x = x0; x < x1; ++x) {
            const std::uint8_t* path = columns.advance(x, y, std::max(y - 1, 0));
            std::uint8_t* sum = sums_.data() + task.pixel(x, y) * labels;
            for (int v = 0; v < task.vectors; ++v)
                storeBytes(sum + kLanes * v,
                           loadBytes(sum + kLanes * v) + loadBytes(path + kLanes * v));
        }
    }
    columns.restart();
    for (int y = height - 1; y >= 0; --y) {
        for (int x = x0; x < x1; ++x) {
            const std::uint8_t* path = columns.advance(x, y, std::min(y + 1, height - 1));
            const std::size_t i = task.pixel(x, y);
            task.out[i] = valleyOf(sums_.data() + i * labels, path, task.vectors);
            task.out[i].label += task.base[i];
        }
    }
}

}  // namespace mfar
