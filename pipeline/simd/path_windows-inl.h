// Aggregates costs along paths (see path_costs.h) for any multiple of kLabels labels per pixel. The
// path costs of a pixel are kept in an array with a margin at both ends. (path_blocks-inl.h, for 16
// labels, keeps them in registers.) This header is included once per instruction set.
#include "pipeline/simd/path_costs.h"

#include <algorithm>
#include <cstdlib>
#include <hwy/highway.h>

#if defined(MFAR_SIMD_PATH_WINDOWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_PATH_WINDOWS_INL_H
#undef MFAR_SIMD_PATH_WINDOWS_INL_H
#else
#define MFAR_SIMD_PATH_WINDOWS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Path cost of labels outside a pixel's window. Both margins around the pixel's path costs contain
/// this value. It is so high that these labels never win.
constexpr std::uint8_t kNever = 200;

/// Returns the length of one margin around a pixel's path costs [labels]. A margin is longer than a
/// window, so reading is safe even if the windows of two neighbouring pixels have no label in
/// common. `vectors`: length of a window, divided by kLabels.
HWY_INLINE std::size_t marginOf(int vectors) {
    return static_cast<std::size_t>(kLabels) * (vectors + 1);
}

HWY_INLINE std::size_t strideOf(int vectors) {
    return static_cast<std::size_t>(kLabels) * vectors + 2 * marginOf(vectors);
}

/// Advances path costs by one pixel. `from`: path costs of the previous pixel. `shift`: first label
/// of the pixel's window minus that of the previous pixel's window. The smallest path cost is
/// subtracted from all of them, so that they stay small.
HWY_INLINE void windowStep(const std::uint8_t* from, int shift, std::uint8_t stepPenalty,
                           std::uint8_t jumpPenalty, const std::uint8_t* cost, std::uint8_t* to,
                           int labels) {
    const hn::CappedTag<std::uint8_t, kLabels> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const std::uint8_t* at = from + std::clamp(shift, -labels - 1, labels + 1);
    const auto step = hn::Set(d, stepPenalty), jump = hn::Set(d, jumpPenalty);
    auto least = hn::Set(d, 255);
    for (int k = 0; k < labels; k += lanes) {
        const auto same = hn::LoadU(d, at + k);
        const auto beside =
            hn::Add(hn::Min(hn::LoadU(d, at + k - 1), hn::LoadU(d, at + k + 1)), step);
        const auto sum = hn::Add(hn::LoadU(d, cost + k), hn::Min(hn::Min(same, beside), jump));
        least = hn::Min(least, sum);
        hn::StoreU(sum, d, to + k);
    }
    HWY_ALIGN std::uint8_t each[kLabels];
    hn::Store(least, d, each);
    least = hn::Set(d, *std::min_element(each, each + lanes));
    for (int k = 0; k < labels; k += lanes)
        hn::StoreU(hn::Sub(hn::LoadU(d, to + k), least), d, to + k);
}

HWY_INLINE void addLabels(const std::uint8_t* path, int labels, std::uint8_t* sums) {
    const hn::CappedTag<std::uint8_t, kLabels> d;
    for (int k = 0; k < labels; k += static_cast<int>(hn::Lanes(d)))
        hn::StoreU(hn::Add(hn::LoadU(d, sums + k), hn::LoadU(d, path + k)), d, sums + k);
}

HWY_INLINE void windowMove(const PathVolume& v, std::ptrdiff_t from, std::ptrdiff_t to,
                           const std::uint8_t* last, std::uint8_t* now) {
    const int labels = kLabels * v.vectors;
    windowStep(last, v.base[to] - v.base[from], v.step,
               v.jumps[std::abs(v.guide[to] - v.guide[from])], v.costs + to * labels, now, labels);
}

HWY_INLINE void windowsAlongRow(const PathVolume& v, int y, std::uint8_t* scratch) {
    const int labels = kLabels * v.vectors;
    const std::ptrdiff_t width = v.size.width, row = y * width;
    std::fill_n(scratch, 2 * strideOf(v.vectors), kNever);
    std::uint8_t* last = scratch + marginOf(v.vectors);
    std::uint8_t* now = last + strideOf(v.vectors);
    std::fill_n(last, labels, std::uint8_t{0});
    for (std::ptrdiff_t x = 0; x < width; ++x) {
        windowMove(v, row + std::max<std::ptrdiff_t>(x - 1, 0), row + x, last, now);
        std::copy_n(now, labels, v.sums + (row + x) * labels);
        std::swap(last, now);
    }
    std::fill_n(last, labels, std::uint8_t{0});
    for (std::ptrdiff_t x = width - 1; x >= 0; --x) {
        windowMove(v, row + std::min(x + 1, width - 1), row + x, last, now);
        addLabels(now, labels, v.sums + (row + x) * labels);
        std::swap(last, now);
    }
}

HWY_INLINE Valley windowValley(const std::uint8_t* sums, const std::uint8_t* path, int labels,
                               int base) {
    int best = 0;
    for (int k = 1; k < labels; ++k)
        if (sums[k] + path[k] < sums[best] + path[best]) best = k;
    const int least = sums[best] + path[best];
    const auto riseOf = [&](int k) {
        if (k < 0 || k >= labels) return Valley::kUnknown;
        return static_cast<std::uint8_t>(std::min(sums[k] + path[k] - least, 254));
    };
    return {base + best, {riseOf(best - 2), riseOf(best - 1), riseOf(best + 1), riseOf(best + 2)}};
}

HWY_INLINE void windowsAlongColumns(const PathVolume& v, int first, int last, std::uint8_t* scratch,
                                    Valley* out) {
    const int labels = kLabels * v.vectors;
    const std::ptrdiff_t width = v.size.width, height = v.size.height;
    const std::size_t stride = strideOf(v.vectors), all = (last - first + 1) * stride;
    std::uint8_t* paths = scratch + marginOf(v.vectors);
    std::uint8_t* fresh = paths + (last - first) * stride;
    const auto pass = [&](bool down) {
        std::fill_n(scratch, all, kNever);
        for (int x = first; x < last; ++x)
            std::fill_n(paths + (x - first) * stride, labels, std::uint8_t{0});
        for (std::ptrdiff_t n = 0; n < height; ++n) {
            const std::ptrdiff_t y = down ? n : height - 1 - n, before = n > 0 ? width : 0;
            for (std::ptrdiff_t x = first; x < last; ++x) {
                const std::ptrdiff_t i = y * width + x;
                std::uint8_t* path = paths + (x - first) * stride;
                windowMove(v, down ? i - before : i + before, i, path, fresh);
                std::copy_n(fresh, labels, path);
                std::uint8_t* sums = v.sums + i * labels;
                if (down)
                    addLabels(path, labels, sums);
                else
                    out[i] = windowValley(sums, path, labels, v.base[i]);
            }
        }
    };
    pass(true);
    pass(false);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
