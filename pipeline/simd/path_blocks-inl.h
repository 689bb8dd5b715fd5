// Aggregates costs along paths (see path_costs.h) in registers, for pixels with a window of 16
// labels. A block of 16 bytes contains the path costs of one pixel's labels; a vector contains
// several blocks. Path costs are stored as 255 - cost. So a zero, which byte shifts and look-ups
// insert for a label outside the window, is the highest cost and never wins. This header is
// included once per instruction set.
#include "pipeline/simd/path_costs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <hwy/highway.h>

#if defined(MFAR_SIMD_PATH_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MFAR_SIMD_PATH_BLOCKS_INL_H
#undef MFAR_SIMD_PATH_BLOCKS_INL_H
#else
#define MFAR_SIMD_PATH_BLOCKS_INL_H
#endif

#if HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kBlocks = HWY_MAX_BYTES / 16;
static_assert(kRowsTogether % kBlocks == 0 && kColumnsTogether % kBlocks == 0);

template <int Blocks>
using DBlocks = hn::FixedTag<std::uint8_t, 16 * Blocks>;
template <int Blocks>
using VBlocks = hn::Vec<DBlocks<Blocks>>;

template <int Blocks>
HWY_INLINE VBlocks<Blocks> everywhere(const std::array<std::uint8_t, 16>& bytes) {
    return hn::LoadDup128(DBlocks<Blocks>(), bytes.data());
}

template <int Blocks>
HWY_INLINE VBlocks<Blocks> loadApart(const std::uint8_t* from, std::ptrdiff_t apart) {
    if constexpr (Blocks == 1)
        return hn::LoadU(DBlocks<1>(), from);
    else
        return hn::Combine(DBlocks<Blocks>(),
                           loadApart<Blocks / 2>(from + Blocks / 2 * apart, apart),
                           loadApart<Blocks / 2>(from, apart));
}

template <int Blocks>
HWY_INLINE void storeApart(VBlocks<Blocks> v, std::uint8_t* to, std::ptrdiff_t apart) {
    if constexpr (Blocks == 1) {
        hn::StoreU(v, DBlocks<1>(), to);
    } else {
        const DBlocks<Blocks / 2> half;
        storeApart<Blocks / 2>(hn::LowerHalf(half, v), to, apart);
        storeApart<Blocks / 2>(hn::UpperHalf(half, v), to + Blocks / 2 * apart, apart);
    }
}

template <int Blocks>
class Stepper {
public:
    using D = DBlocks<Blocks>;
    using V = VBlocks<Blocks>;

    explicit Stepper(const PathVolume& volume)
        : step_(hn::Set(d_, volume.step)), last_(hn::Set(hn::RebindToSigned<D>(), 15)),
          one_(hn::Set(d_, 1)),
          places_(everywhere<Blocks>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15})),
          byTwo_(everywhere<Blocks>({2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1})),
          byOne_(everywhere<Blocks>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0})) {
        HWY_ALIGN std::array<std::uint8_t, 16 * Blocks> blocks;
        for (int i = 0; i < 16 * Blocks; ++i)
            blocks[i] = static_cast<std::uint8_t>(i / 16);
        block_ = hn::Load(d_, blocks.data());
    }

    HWY_INLINE V spread(const std::uint8_t* bytes) const {
        if constexpr (Blocks == 1) {
            return hn::Set(d_, bytes[0]);
        } else {
            std::uint32_t word = 0;
            std::memcpy(&word, bytes, Blocks);
            const hn::Repartition<std::uint32_t, D> words;
            return hn::TableLookupBytes(hn::BitCast(d_, hn::Set(words, word)), block_);
        }
    }

    /// Advances path costs by one pixel. `path`: 255 - path cost of each label at the previous
    /// pixel. `cost`: matching costs of the new pixel. `shifts` and `jumps` have one byte per
    /// block. `shifts`: first label of the new pixel's window minus that of the previous pixel's.
    /// `jumps`: penalty for a label change of more than one. Returns 255 - path cost at the new
    /// pixel.
    HWY_INLINE V advance(V path, const std::uint8_t* shifts, const std::uint8_t* jumps,
                         V cost) const {
        std::uint32_t moved = 0;
        std::memcpy(&moved, shifts, Blocks);
        V same = path, beside;
        if (moved == 0) {
            beside = hn::Max(hn::ShiftLeftBytes<1>(d_, path), hn::ShiftRightBytes<1>(d_, path));
        } else {
            const V place = hn::Add(places_, spread(shifts));
            same = taken(path, place);
            beside = hn::Max(taken(path, hn::Sub(place, one_)), taken(path, hn::Add(place, one_)));
        }
        const V jump = hn::Not(spread(jumps));
        const V best = hn::Max(hn::Max(same, jump), hn::SaturatedSub(beside, step_));
        const V sum = hn::Sub(best, cost);
        return hn::Add(sum, hn::Not(greatest(sum)));
    }

    /// Returns the bytes of a block at the given indices, or 0 where an index is outside the block.
    HWY_INLINE V taken(V block, V place) const {
        const hn::RebindToSigned<D> dSigned;
        const auto at = hn::BitCast(dSigned, place);
        const auto beyond = hn::VecFromMask(dSigned, hn::Gt(at, last_));
        return hn::TableLookupBytesOr0(block, hn::BitCast(d_, hn::Or(at, beyond)));
    }

private:
    HWY_INLINE V greatest(V v) const {
        const hn::Repartition<std::uint32_t, D> words;
        v = hn::Max(v, hn::BitCast(d_, hn::Shuffle1032(hn::BitCast(words, v))));
        v = hn::Max(v, hn::BitCast(d_, hn::Shuffle2301(hn::BitCast(words, v))));
        v = hn::Max(v, hn::TableLookupBytes(v, byTwo_));
        return hn::Max(v, hn::TableLookupBytes(v, byOne_));
    }

    D d_;
    V step_;
    hn::Vec<hn::RebindToSigned<D>> last_;
    V one_, places_, byTwo_, byOne_, block_;
};

/// Computes penalties() and shifts() for each pixel `to` and the pixel `from` before it on a path.
class Neighbours {
public:
    explicit Neighbours(const PathVolume& volume)
        : jumps_(volume.jumps), chunks_((volume.jumpDifferences + 15) / 16) {}

    /// Computes the penalty for a label change of more than one between the pixels `from` and `to`,
    /// for `count` pixels (at most kMost). `to`, `from`: values of PathVolume::guide at these
    /// pixels. Writes whole vectors, so `out` needs kRoom bytes.
    static constexpr int kMost = 64, kRoom = 2 * kMost;
    HWY_INLINE void penalties(const std::uint8_t* to, const std::uint8_t* from, int count,
                              std::uint8_t* out) const {
        forPart(to, from, count,
                [&](auto d, const std::uint8_t* a, const std::uint8_t* b, int i) HWY_ATTR {
                    const auto x = hn::LoadU(d, a), y = hn::LoadU(d, b);
                    const auto apart = hn::Sub(hn::Max(x, y), hn::Min(x, y));
                    const auto low = hn::And(apart, hn::Set(d, 15)),
                               high = hn::AndNot(hn::Set(d, 15), apart);
                    auto jump = hn::Set(d, jumps_[255]);
                    for (int c = 0; c < chunks_; ++c) {
                        const auto table = hn::LoadDup128(d, jumps_ + 16L * c);
                        const auto here =
                            hn::Eq(high, hn::Set(d, static_cast<std::uint8_t>(16 * c)));
                        jump = hn::IfThenElse(here, hn::TableLookupBytes(table, low), jump);
                    }
                    hn::StoreU(jump, d, out + i);
                });
    }
    /// Computes the shift between the windows of two neighbouring pixels, for `count` pairs: first
    /// label of the window at `to` minus first label of the window at `from`. `to`, `from`: values
    /// of PathVolume::base. The shift is clamped to -(kLabels + 1) to kLabels + 1.
    HWY_INLINE static void shifts(const std::int16_t* to, const std::int16_t* from, int count,
                                  std::uint8_t* out) {
        for (int i = 0; i < count; ++i)
            out[i] =
                static_cast<std::uint8_t>(std::clamp(to[i] - from[i], -kLabels - 1, kLabels + 1));
    }

private:
    template <class Body>
    HWY_INLINE static void forPart(const std::uint8_t* to, const std::uint8_t* from, int count,
                                   const Body& body) {
        const hn::CappedTag<std::uint8_t, kMost> d;
        const int lanes = static_cast<int>(hn::Lanes(d));
        int i = 0;
        for (; i + lanes <= count; i += lanes)
            body(d, to + i, from + i, i);
        if (i >= count) return;
        HWY_ALIGN std::uint8_t a[kMost] = {}, b[kMost] = {};
        std::copy_n(to + i, count - i, a);
        std::copy_n(from + i, count - i, b);
        body(d, a, b, i);
    }

    const std::uint8_t* jumps_;
    int chunks_;
};

/// Results of Neighbours for successive pixels of `Blocks` rows: penalties for label changes
/// (`jumps`) and shifts of the window. Both arrays begin with the first pixel of each row, followed
/// by the second pixel of each row.
template <int Blocks>
struct RunOfRows {
    HWY_ALIGN std::uint8_t jumps[Neighbours::kMost * 4], shifts[Neighbours::kMost * 4];

    /// Computes jumps and shifts for pixels [x, x + count) of the rows from y on. `toFrom`: column
    /// of the previous pixel on the path minus that of the pixel itself. The first pixel of a path
    /// has no previous pixel; its jump and shift are 0.
    HWY_INLINE void fill(const Neighbours& between, const PathVolume& v, int x, int count, int y,
                         int toFrom) {
        HWY_ALIGN std::uint8_t jump[4][Neighbours::kRoom] = {}, shift[4][Neighbours::kRoom] = {};
        const int skip = toFrom < 0 && x == 0 ? 1 : 0;
        const int drop = toFrom > 0 && x + count == v.size.width ? 1 : 0;
        const int inner = count - skip - drop;
        for (int r = 0; r < Blocks; ++r) {
            const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y + r) * v.size.width + x + skip;
            between.penalties(v.guide + at, v.guide + at + toFrom, inner, jump[r] + skip);
            Neighbours::shifts(v.base + at, v.base + at + toFrom, inner, shift[r] + skip);
            if (drop == 1) jump[r][count - 1] = 0;
        }
        interleave(jump, count, jumps);
        interleave(shift, count, shifts);
    }

private:
    HWY_INLINE static void interleave(const std::uint8_t (&rows)[4][Neighbours::kRoom], int count,
                                      std::uint8_t* out) {
        const hn::CappedTag<std::uint8_t, Neighbours::kMost> d;
        for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
            const auto a = hn::LoadU(d, rows[0] + i);
            if constexpr (Blocks == 1)
                hn::StoreU(a, d, out + i);
            else if constexpr (Blocks == 2)
                hn::StoreInterleaved2(a, hn::LoadU(d, rows[1] + i), d, out + 2L * i);
            else
                hn::StoreInterleaved4(a, hn::LoadU(d, rows[1] + i), hn::LoadU(d, rows[2] + i),
                                      hn::LoadU(d, rows[3] + i), d, out + 4L * i);
        }
    }
};

/// Computes the path costs along rows in both directions at once. Each pixel of a path needs the
/// result of the previous one. The two directions are independent, so the CPU can work on one path
/// while it waits for the result of the other.
template <int Blocks>
HWY_INLINE void blocksAlongRows(const PathVolume& v, int y) {
    static_assert(Blocks == 1 || Blocks == 2 || Blocks == 4);
    const DBlocks<Blocks> d;
    const Stepper<Blocks> stepper(v);
    const Neighbours between(v);
    const int width = v.size.width;
    const std::ptrdiff_t apart = static_cast<std::ptrdiff_t>(width) * kLabels;
    const std::uint8_t* costs = v.costs + y * apart;
    std::uint8_t* sums = v.sums + y * apart;
    RunOfRows<Blocks> right, left;
    auto fromLeft = hn::Set(d, 255), fromRight = fromLeft;
    const auto keep = [&](VBlocks<Blocks> path, std::uint8_t* to, bool again) HWY_ATTR {
        auto sum = hn::Not(path);
        if (again) sum = hn::Add(sum, loadApart<Blocks>(to, apart));
        storeApart<Blocks>(sum, to, apart);
    };
    for (int begin = 0; begin < width; begin += Neighbours::kMost) {
        const int count = std::min(Neighbours::kMost, width - begin), end = width - begin - count;
        right.fill(between, v, begin, count, y, -1);
        left.fill(between, v, end, count, y, 1);
        for (int i = 0; i < count; ++i) {
            const std::ptrdiff_t there = kLabels * static_cast<std::ptrdiff_t>(begin + i);
            const std::ptrdiff_t back = apart - kLabels - there;
            const int j = Blocks * i, k = Blocks * (count - 1 - i);
            fromLeft = stepper.advance(fromLeft, right.shifts + j, right.jumps + j,
                                       loadApart<Blocks>(costs + there, apart));
            fromRight = stepper.advance(fromRight, left.shifts + k, left.jumps + k,
                                        loadApart<Blocks>(costs + back, apart));
            keep(fromLeft, sums + there, there > back);
            keep(fromRight, sums + back, there >= back);
        }
    }
}

/// Finds the cheapest label of each pixel. `sums`: sums of the path costs from three directions.
/// `path`: 255 - path cost from the fourth direction.
template <int Blocks>
HWY_INLINE void valleysOf(const Stepper<Blocks>& stepper, VBlocks<Blocks> sums,
                          VBlocks<Blocks> path, const std::int16_t* base, Valley* out) {
    const DBlocks<Blocks> d;
    const hn::Repartition<std::int16_t, DBlocks<Blocks>> d16;
    const hn::Repartition<std::uint32_t, DBlocks<Blocks>> d32;
    const auto byte = hn::Set(d16, 255);
    const auto a = hn::BitCast(d16, sums), b = hn::BitCast(d16, hn::Not(path));
    const auto odds = [&](auto v) HWY_ATTR { return hn::And(hn::ShiftRight<8>(v), byte); };
    const auto even = hn::Add(hn::And(a, byte), hn::And(b, byte)), odd = hn::Add(odds(a), odds(b));
    // The label with the smallest sum wins. If sums are equal, the smallest label wins.
    const auto places =
        hn::BitCast(d16, everywhere<Blocks>({0, 0, 2, 0, 4, 0, 6, 0, 8, 0, 10, 0, 12, 0, 14, 0}));
    const auto evenKey = hn::Or(hn::ShiftLeft<4>(even), places);
    const auto oddKey = hn::Or(hn::ShiftLeft<4>(odd), hn::Add(places, hn::Set(d16, 1)));
    auto key = hn::Min(evenKey, oddKey);
    const auto exchange = [&](auto words) HWY_ATTR { return hn::BitCast(d16, words); };
    key = hn::Min(key, exchange(hn::Shuffle1032(hn::BitCast(d32, key))));
    key = hn::Min(key, exchange(hn::Shuffle2301(hn::BitCast(d32, key))));
    const auto words = hn::BitCast(d32, key);
    key = hn::Min(key, exchange(hn::Or(hn::ShiftLeft<16>(words), hn::ShiftRight<16>(words))));
    const auto least = hn::ShiftRight<4>(key), most = hn::Set(d16, 254);
    const auto evenRise = hn::Min(hn::Sub(even, least), most);
    const auto oddRise = hn::Min(hn::Sub(odd, least), most);
    const auto rises = hn::BitCast(d, hn::Or(evenRise, hn::ShiftLeft<8>(oddRise)));
    const auto best = hn::And(key, hn::Set(d16, 15));
    const auto place = hn::BitCast(d, hn::Or(best, hn::ShiftLeft<8>(best)));
    const auto beside = everywhere<Blocks>({254, 255, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const auto found = hn::Not(stepper.taken(hn::Not(rises), hn::Add(place, beside)));
    HWY_ALIGN std::uint8_t rise[16 * Blocks], label[16 * Blocks];
    hn::Store(found, d, rise);
    hn::Store(place, d, label);
    for (int i = 0; i < Blocks; ++i) {
        out[i].label = base[i] + label[16 * i];
        std::memcpy(out[i].rise.data(), rise + 16L * i, 4);
    }
}

/// Computes the path costs of adjacent columns, row by row, first downwards and then upwards.
class BlockColumns {
public:
    BlockColumns(const PathVolume& volume, int first, int last)
        : v_(volume), between_(volume), first_(first), count_(last - first) {}

    HWY_INLINE void down() {
        const Stepper<kBlocks> several(v_);
        const Stepper<1> one(v_);
        restart();
        for (int y = 0; y < v_.size.height; ++y) {
            enter(y, y > 0 ? -1 : 0);
            int x = 0;
            for (; x + kBlocks <= count_; x += kBlocks)
                add(several, y, x);
            for (; x < count_; ++x)
                add(one, y, x);
        }
    }
    HWY_INLINE void up(Valley* out) {
        const Stepper<kBlocks> several(v_);
        const Stepper<1> one(v_);
        restart();
        for (int y = v_.size.height - 1; y >= 0; --y) {
            enter(y, y + 1 < v_.size.height ? 1 : 0);
            int x = 0;
            for (; x + kBlocks <= count_; x += kBlocks)
                finish(several, y, x, out);
            for (; x < count_; ++x)
                finish(one, y, x, out);
        }
    }

private:
    HWY_INLINE void restart() { std::fill_n(paths_, kLabels * count_, std::uint8_t{255}); }
    HWY_INLINE std::ptrdiff_t pixel(int y, int x) const {
        return static_cast<std::ptrdiff_t>(y) * v_.size.width + first_ + x;
    }
    HWY_INLINE void enter(int y, int toFrom) {
        const std::ptrdiff_t at = pixel(y, 0), from = at + toFrom * v_.size.width;
        between_.penalties(v_.guide + at, v_.guide + from, count_, jumps_);
        Neighbours::shifts(v_.base + at, v_.base + from, count_, shifts_);
    }
    template <int Blocks>
    HWY_INLINE VBlocks<Blocks> advanced(const Stepper<Blocks>& stepper, int y, int x) {
        const DBlocks<Blocks> d;
        std::uint8_t* own = paths_ + kLabels * x;
        const auto path = stepper.advance(hn::LoadU(d, own), shifts_ + x, jumps_ + x,
                                          hn::LoadU(d, v_.costs + kLabels * pixel(y, x)));
        hn::StoreU(path, d, own);
        return path;
    }
    template <int Blocks>
    HWY_INLINE void add(const Stepper<Blocks>& stepper, int y, int x) {
        const DBlocks<Blocks> d;
        std::uint8_t* sums = v_.sums + kLabels * pixel(y, x);
        const auto path = advanced(stepper, y, x);
        hn::StoreU(hn::Add(hn::LoadU(d, sums), hn::Not(path)), d, sums);
    }
    template <int Blocks>
    HWY_INLINE void finish(const Stepper<Blocks>& stepper, int y, int x, Valley* out) {
        const DBlocks<Blocks> d;
        const std::ptrdiff_t i = pixel(y, x);
        const auto path = advanced(stepper, y, x);
        valleysOf<Blocks>(stepper, hn::LoadU(d, v_.sums + kLabels * i), path, v_.base + i, out + i);
    }

    const PathVolume& v_;
    Neighbours between_;
    int first_, count_;
    alignas(64) std::uint8_t paths_[kLabels * kColumnsTogether];
    std::uint8_t jumps_[Neighbours::kRoom], shifts_[Neighbours::kRoom];
};

HWY_INLINE void blocksAlongColumns(const PathVolume& v, int first, int last, Valley* out) {
    BlockColumns columns(v, first, last);
    columns.down();
    columns.up(out);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // HWY_TARGET

#endif
