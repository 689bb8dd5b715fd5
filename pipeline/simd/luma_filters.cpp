#include "pipeline/simd/luma_filters.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/luma_filters.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

using DWords = hn::ScalableTag<std::uint16_t>;

template <class D>
HWY_INLINE void storeBytes(D /*d*/, hn::Vec<D> words, std::uint8_t* to) {
    const hn::RebindToSigned<D> dSigned;
    const hn::Rebind<std::uint8_t, D> dByte;
    hn::StoreU(hn::DemoteTo(dByte, hn::BitCast(dSigned, words)), dByte, to);
}

template <class D>
HWY_INLINE hn::Vec<D> loadPairs(D d, const std::uint8_t* from) {
    return hn::LoadU(d, reinterpret_cast<const std::uint16_t*>(from));
}

void HalveRow(const std::uint8_t* first, const std::uint8_t* second, std::size_t width,
              std::uint8_t* out) {
    forLanes(DWords(), width, [&](auto d, std::size_t x) HWY_ATTR {
        const auto sumOf = [&](auto pair) HWY_ATTR {
            return hn::Add(hn::And(pair, hn::Set(d, 255)), hn::ShiftRight<8>(pair));
        };
        const auto sum =
            hn::Add(sumOf(loadPairs(d, first + 2 * x)), sumOf(loadPairs(d, second + 2 * x)));
        storeBytes(d, hn::ShiftRight<2>(hn::Add(sum, hn::Set(d, 2))), out + x);
    });
}

void ThinRow(const std::uint8_t* in, std::size_t width, std::uint8_t* out) {
    if (width == 0) return;
    forLanes(DWords(), width - 1, [&](auto d, std::size_t x) HWY_ATTR {
        storeBytes(d, hn::And(loadPairs(d, in + 2 * x), hn::Set(d, 255)), out + x);
    });
    out[width - 1] = in[2 * (width - 1)];
}

void SmoothRow(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
               std::size_t width, int side, std::uint8_t* out) {
    // The row is processed in pieces of kRun columns. `column` contains the weighted sum of each
    // column's three pixels [1/256 grey level], with one more column at both ends.
    constexpr std::size_t kRun = 256;
    HWY_ALIGN std::uint16_t column[kRun + 2];
    const auto s = static_cast<std::uint16_t>(side), c = static_cast<std::uint16_t>(256 - 2 * side);
    for (std::size_t begin = 0; begin < width; begin += kRun) {
        const std::size_t count = std::min(kRun, width - begin);
        const std::size_t first = begin - (begin > 0 ? 1 : 0);
        const std::size_t last = std::min(begin + count + 1, width);
        std::uint16_t* sums = column + 1 - (begin - first);
        forLanes(DWords(), last - first, [&](auto d, std::size_t i) HWY_ATTR {
            const hn::Rebind<std::uint8_t, decltype(d)> dByte;
            const auto at = [&](const std::uint8_t* row) HWY_ATTR {
                return hn::PromoteTo(d, hn::LoadU(dByte, row + first + i));
            };
            const auto beside = hn::Mul(hn::Set(d, s), hn::Add(at(above), at(below)));
            hn::StoreU(hn::Add(beside, hn::Mul(hn::Set(d, c), at(here))), d, sums + i);
        });
        if (begin == 0) column[0] = column[1];
        if (last == begin + count) column[count + 1] = column[count];
        forLanes(hn::ScalableTag<std::uint32_t>(), count, [&](auto d, std::size_t i) HWY_ATTR {
            const hn::Rebind<std::uint16_t, decltype(d)> dWord;
            const hn::RebindToSigned<decltype(d)> dInt;
            const hn::Rebind<std::uint8_t, decltype(d)> dByte;
            const auto at = [&](std::size_t k) HWY_ATTR {
                return hn::PromoteTo(d, hn::LoadU(dWord, column + i + k));
            };
            const auto beside = hn::Mul(hn::Set(d, s), hn::Add(at(0), at(2)));
            const auto sum = hn::Add(beside, hn::Mul(hn::Set(d, c), at(1)));
            const auto mean = hn::ShiftRight<16>(hn::Add(sum, hn::Set(d, 32768)));
            hn::StoreU(hn::DemoteTo(dByte, hn::BitCast(dInt, mean)), dByte, out + begin + i);
        });
    }
}

void NoiseColumns(const Rows<const std::uint8_t>& picture, int first, int rows, std::size_t width,
                  std::uint16_t* out) {
    forLanes(hn::ScalableTag<std::int16_t>(), width, [&](auto d, std::size_t i) HWY_ATTR {
        const hn::Rebind<std::uint8_t, decltype(d)> dByte;
        const hn::RebindToUnsigned<decltype(d)> dWord;
        const auto bend = [&](int y) HWY_ATTR {
            const std::uint8_t* row = picture[y] + i;
            const auto at = [&](int k)
                                HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(dByte, row + k)); };
            const auto middle = at(1);
            return hn::Sub(hn::Add(at(0), at(2)), hn::Add(middle, middle));
        };
        auto sum = hn::Zero(d), above = bend(first - 1), here = bend(first);
        for (int y = first; y < first + rows; ++y) {
            const auto below = bend(y + 1);
            const auto mask = hn::Sub(hn::Add(above, below), hn::Add(here, here));
            sum = hn::Add(sum, hn::Abs(mask));
            above = here;
            here = below;
        }
        hn::StoreU(hn::BitCast(dWord, sum), dWord, out + i);
    });
}

void AddWeighted(const std::uint8_t* from, float weight, std::size_t count, float* to) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> dInt;
    const hn::Rebind<std::uint8_t, decltype(d)> dByte;
    const auto w = hn::Set(d, weight);
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
        const auto v = hn::ConvertTo(d, hn::PromoteTo(dInt, hn::LoadU(dByte, from + i)));
        hn::StoreU(hn::MulAdd(w, v, hn::LoadU(d, to + i)), d, to + i);
    }
    for (; i < count; ++i)
        to[i] += weight * static_cast<float>(from[i]);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(HalveRow);
HWY_EXPORT(ThinRow);
HWY_EXPORT(SmoothRow);
HWY_EXPORT(NoiseColumns);
HWY_EXPORT(AddWeighted);

void halveRow(const std::uint8_t* first, const std::uint8_t* second, std::size_t width,
              std::uint8_t* out) {
    HWY_DYNAMIC_DISPATCH(HalveRow)(first, second, width, out);
}

void thinRow(const std::uint8_t* in, std::size_t width, std::uint8_t* out) {
    HWY_DYNAMIC_DISPATCH(ThinRow)(in, width, out);
}

void smoothRow(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
               std::size_t width, int side, std::uint8_t* out) {
    HWY_DYNAMIC_DISPATCH(SmoothRow)(above, here, below, width, side, out);
}

void noiseColumns(const Rows<const std::uint8_t>& picture, int first, int rows, std::size_t width,
                  std::uint16_t* out) {
    HWY_DYNAMIC_DISPATCH(NoiseColumns)(picture, first, rows, width, out);
}

void addWeighted(const std::uint8_t* from, float weight, std::size_t count, float* to) {
    HWY_DYNAMIC_DISPATCH(AddWeighted)(from, weight, count, to);
}

}  // namespace mfar::simd
#endif
