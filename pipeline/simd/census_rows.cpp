#include "pipeline/simd/census_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/census_rows.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

constexpr int kSide = 2 * kCensusRadius + 1;

template <class D>
HWY_INLINE hn::Vec<D> bitsFrom(D d, int first, const std::uint8_t* const (&rows)[kSide],
                               std::size_t x, hn::Vec<D> centre) {
    auto bits = hn::Zero(d);
    for (int n = first; n < first + 8; ++n) {
        const int place = n < kSide * kSide / 2 ? n : n + 1;
        const auto neighbour = hn::LoadU(d, rows[place / kSide] + x + place % kSide);
        const auto bit = hn::Set(d, static_cast<std::uint8_t>(0x80 >> (n - first)));
        bits = hn::Or(bits, hn::IfThenElseZero(hn::Lt(neighbour, centre), bit));
    }
    return bits;
}

void CensusRow(const std::uint8_t* const (&rows)[kSide], std::size_t width,
               const std::uint8_t* seen, std::uint32_t* out) {
    const hn::ScalableTag<std::uint8_t> all;
    forLanes(all, width, [&](auto d, std::size_t x) HWY_ATTR {
        const auto centre = hn::LoadU(d, rows[kCensusRadius] + x + kCensusRadius);
        const auto zero = hn::Zero(d);
        auto high = bitsFrom(d, 0, rows, x, centre), middle = bitsFrom(d, 8, rows, x, centre);
        auto low = bitsFrom(d, 16, rows, x, centre), none = zero;
        if (seen != nullptr) {
            const auto unseen = hn::Eq(hn::LoadU(d, seen + x), zero);
            high = hn::IfThenZeroElse(unseen, high);
            middle = hn::IfThenZeroElse(unseen, middle);
            low = hn::IfThenZeroElse(unseen, low);
            none = hn::IfThenElseZero(unseen, hn::Set(d, 0x80));
        }
        // The low byte is stored first, because the words of `out` are little-endian.
        hn::StoreInterleaved4(low, middle, high, none, d, reinterpret_cast<std::uint8_t*>(out + x));
    });
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(CensusRow);

void censusRow(const std::uint8_t* const (&rows)[2 * kCensusRadius + 1], std::size_t width,
               const std::uint8_t* seen, std::uint32_t* out) {
    HWY_DYNAMIC_DISPATCH(CensusRow)(rows, width, seen, out);
}

}  // namespace mfar::simd
#endif
