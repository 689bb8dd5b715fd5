#include "pipeline/simd/patch_sums.h"

#include "pipeline/engine/params/patch.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/patch_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Values (grey level - 128) are stored in steps of 1/64. So a patch's sum of squares fits into four
// 32-bit lanes.
constexpr float kOne = 64;
constexpr float kPixels = params::kPatchPixels;
constexpr int kRows = 8;
// Number of cells that are processed together. First, each cell gets four partial sums. Then these
// are added for several cells at once.
constexpr int kChunk = 16;

/// First pixel of each cell's patch in the video and in the still.
struct Origins {
    HWY_ALIGN std::array<float, kChunk> videoX, videoY;
    HWY_ALIGN std::array<std::int32_t, 2 * kChunk> x, y;
    // Interpolation weights [2^-15] of the next column and row, stored twice in 32 bits.
    HWY_ALIGN std::array<std::int32_t, 2 * kChunk> fx, fy;
};

struct Partial {
    using Sums = std::array<std::int32_t, 4 * kChunk>;
    HWY_ALIGN Sums a, b, aa, ab, bb;
};

template <class D>
void OriginsAlong(D d, const float* flow, const float* video, float last, std::int32_t* whole,
                  std::int32_t* fraction) {
    const hn::RebindToSigned<D> di;
    const auto least = hn::Set(d, -7.0F), most = hn::Set(d, last);
    for (std::size_t i = 0; i < kChunk; i += hn::Lanes(d)) {
        const auto at = hn::Add(hn::Load(d, video + i), hn::LoadU(d, flow + i));
        const auto origin = hn::IfThenElse(hn::Gt(at, least), hn::Min(at, most), least);
        const auto floor = hn::Floor(origin);
        const auto share = hn::Mul(hn::Sub(origin, floor), hn::Set(d, 32768.0F));
        const auto f = hn::ConvertTo(di, hn::Min(share, hn::Set(d, 32767.0F)));
        hn::Store(hn::ConvertTo(di, floor), di, whole + i);
        hn::Store(hn::Or(f, hn::ShiftLeft<16>(f)), di, fraction + i);
    }
}

#if HWY_TARGET == HWY_SCALAR

constexpr int kBlocks = 1;

inline int Between(int a, int b, int f) {
    return a + (((b - a) * f + (1 << 14)) >> 15);
}

void SumPatches(const std::uint8_t* const* video, const PatchLevel& still, int first, int /*count*/,
                const Origins& origins, Partial& out) {
    const int x = origins.x[first], y = origins.y[first];
    const int fx = origins.fx[first] & 0xFFFF, fy = origins.fy[first] & 0xFFFF;
    const auto rowAt = [&](int row, int* to) {
        const std::uint8_t* p =
            still.origin + std::clamp(y + row, 0, still.height - 1) * still.pitch + x;
        for (int i = 0; i < 8; ++i)
            to[i] = Between((p[i] - 128) * 64, (p[i + 1] - 128) * 64, fx);
    };
    int upper[8], lower[8];
    rowAt(0, upper);
    int a = 0, b = 0;
    std::int64_t aa = 0, ab = 0, bb = 0;
    for (int row = 0; row < kRows; ++row) {
        rowAt(row + 1, lower);
        for (int i = 0; i < 8; ++i) {
            const int p = (video[row][static_cast<int>(origins.videoX[first]) + i] - 128) * 64;
            const int q = Between(upper[i], lower[i], fy);
            upper[i] = lower[i];
            a += p;
            b += q;
            aa += p * p;
            ab += p * q;
            bb += q * q;
        }
    }
    const auto split = [first](std::int64_t sum, Partial::Sums& to) {
        for (int i = 0; i < 4; ++i)
            to[4 * first + i] = static_cast<std::int32_t>((sum + i) >> 2);
    };
    split(a, out.a);
    split(b, out.b);
    split(aa, out.aa);
    split(ab, out.ab);
    split(bb, out.bb);
}

#else

// A block of 16 bytes contains one row of a cell's patch.
#if HWY_ARCH_X86
constexpr int kBlocks = HWY_MAX_BYTES / 16;
#else
constexpr int kBlocks = 1;
#endif
using D8 = hn::FixedTag<std::uint8_t, 16 * kBlocks>;
using D16 = hn::FixedTag<std::int16_t, 8 * kBlocks>;
using D32 = hn::FixedTag<std::int32_t, 4 * kBlocks>;
using V16 = hn::Vec<D16>;
using V32 = hn::Vec<D32>;

template <int kCount, class Pointer>
HWY_INLINE hn::Vec<hn::FixedTag<std::uint8_t, 16 * kCount>> LoadBlocks(const Pointer& at,
                                                                       int from) {
    if constexpr (kCount == 1) {
        return hn::LoadU(hn::FixedTag<std::uint8_t, 16>(), at(from));
    } else {
        const hn::FixedTag<std::uint8_t, 16 * kCount> d;
        const auto lower = LoadBlocks<kCount / 2>(at, from);
        return hn::Combine(d, LoadBlocks<kCount / 2>(at, from + kCount / 2), lower);
    }
}

HWY_INLINE V16 Pixels(hn::Vec<D8> bytes) {
    const D8 d8;
    const auto high = hn::InterleaveLower(d8, hn::Zero(d8), hn::Xor(bytes, hn::Set(d8, 128)));
    return hn::ShiftRight<2>(hn::BitCast(D16(), high));
}

HWY_INLINE V16 Between(V16 a, V16 b, V16 f) {
    return hn::Add(a, hn::MulFixedPoint15(hn::Sub(b, a), f));
}

/// Sums products of lanes. Which products are added in a lane depends on the CPU.
struct Accumulator {
    V32 first, second;

    HWY_INLINE void add(V16 a, V16 b) {
        first = hn::ReorderWidenMulAccumulate(D32(), a, b, first, second);
    }
    HWY_INLINE void store(std::int32_t* to) const { hn::StoreU(hn::Add(first, second), D32(), to); }
};

HWY_INLINE V16 PerBlock(const std::int32_t* values) {
    const D32 d;
    HWY_ALIGN std::int32_t cell[4 * kBlocks];
    for (int i = 0; i < 4 * kBlocks; ++i)
        cell[i] = i / 4;
    return hn::BitCast(D16(),
                       hn::TableLookupLanes(hn::LoadU(d, values), hn::SetTableIndices(d, cell)));
}

template <class VideoRow, class StillRow>
HWY_INLINE void SumRows(const VideoRow& videoRow, const StillRow& stillRow, int first, V16 fx,
                        V16 fy, Partial& out) {
    const D8 d8;
    const D16 d16;
    const auto level = [&](int row) {
        const auto bytes =
            LoadBlocks<kBlocks>([&](int block) HWY_ATTR { return stillRow(block, row); }, 0);
        return Between(Pixels(bytes), Pixels(hn::ShiftRightBytes<1>(d8, bytes)), fx);
    };
    const auto one = hn::Set(d16, 1);
    const V32 zero = hn::Zero(D32());
    Accumulator a{zero, zero}, b = a, aa = a, ab = a, bb = a;
    V16 upper = level(0);
    for (int half = 0; half < 2; ++half) {
        // Sums over four rows fit into 16 bits.
        V16 sumA = hn::Zero(d16), sumB = hn::Zero(d16);
        for (int row = 4 * half; row < 4 * half + 4; ++row) {
            const V16 p = Pixels(
                LoadBlocks<kBlocks>([&](int block) HWY_ATTR { return videoRow(block, row); }, 0));
            const V16 lower = level(row + 1);
            const V16 q = Between(upper, lower, fy);
            upper = lower;
            sumA = hn::Add(sumA, p);
            sumB = hn::Add(sumB, q);
            aa.add(p, p);
            ab.add(p, q);
            bb.add(q, q);
        }
        a.add(sumA, one);
        b.add(sumB, one);
    }
    const std::ptrdiff_t to = 4 * static_cast<std::ptrdiff_t>(first);
    a.store(&out.a[to]);
    b.store(&out.b[to]);
    aa.store(&out.aa[to]);
    ab.store(&out.ab[to]);
    bb.store(&out.bb[to]);
}

/// Computes the sums of kBlocks cells of a chunk, from cell `first` on. The chunk has `count`
/// cells. `video`: rows of the video.
HWY_INLINE void SumPatches(const std::uint8_t* const* video, const PatchLevel& still, int first,
                           int count, const Origins& origins, Partial& out) {
    const V16 fx = PerBlock(&origins.fx[first]), fy = PerBlock(&origins.fy[first]);
    std::ptrdiff_t column[kBlocks];
    int cell[kBlocks];
    const std::uint8_t* at[kBlocks];
    bool inside = true;
    for (int i = 0; i < kBlocks; ++i) {
        cell[i] = std::min(first + i, count - 1);  // results after the last cell are not used
        column[i] = static_cast<std::ptrdiff_t>(origins.videoX[cell[i]]);
        const int y = origins.y[cell[i]];
        inside = inside && y >= 0 && y + kRows < still.height;
        at[i] = still.origin + y * still.pitch + origins.x[cell[i]];
    }
    const auto videoRow = [&](int block, int row) HWY_ATTR { return video[row] + column[block]; };
    if (inside) {
        const auto row = [&](int block, int r) HWY_ATTR { return at[block] + r * still.pitch; };
        SumRows(videoRow, row, first, fx, fy, out);
    } else {
        const auto row = [&](int block, int r) HWY_ATTR {
            const int y = std::clamp(origins.y[cell[block]] + r, 0, still.height - 1);
            return still.origin + y * still.pitch + origins.x[cell[block]];
        };
        SumRows(videoRow, row, first, fx, fy, out);
    }
}

#endif

template <class D>
HWY_INLINE hn::Vec<D> Total(D d, const Partial::Sums& partial, std::size_t cell, float scale) {
    const hn::RebindToSigned<D> di;
    hn::Vec<decltype(di)> p, q, r, s;
    hn::LoadInterleaved4(di, &partial[4 * cell], p, q, r, s);
    const auto first = hn::Add(hn::ConvertTo(d, p), hn::ConvertTo(d, q));
    const auto second = hn::Add(hn::ConvertTo(d, r), hn::ConvertTo(d, s));
    return hn::Mul(hn::Add(first, second), hn::Set(d, scale));
}

template <class D>
void Statistics(D d, const Partial& partial, int count, int to, const PatchSums& out) {
    using Values = std::array<float, kChunk>;
    HWY_ALIGN Values covariance, video, still;
    const auto share = hn::Set(d, -1 / kPixels);
    for (std::size_t i = 0; i < kChunk; i += hn::Lanes(d)) {
        const auto a = Total(d, partial.a, i, 1 / kOne), b = Total(d, partial.b, i, 1 / kOne);
        const auto aMean = hn::Mul(a, share), bMean = hn::Mul(b, share);
        const float squared = 1 / (kOne * kOne);
        const auto aa = hn::MulAdd(a, aMean, Total(d, partial.aa, i, squared));
        const auto bb = hn::MulAdd(b, bMean, Total(d, partial.bb, i, squared));
        hn::Store(hn::MulAdd(a, bMean, Total(d, partial.ab, i, squared)), d, &covariance[i]);
        hn::Store(hn::Max(aa, hn::Zero(d)), d, &video[i]);
        hn::Store(hn::Max(bb, hn::Zero(d)), d, &still[i]);
    }
    std::copy_n(covariance.data(), count, out.covariance + to);
    if (out.varianceVideo != nullptr) std::copy_n(video.data(), count, out.varianceVideo + to);
    std::copy_n(still.data(), count, out.varianceStill + to);
}

void ComparePatches(const PatchLevel& video, const PatchLevel& still, int cellRow, int first,
                    int last, const float* flowX, const float* flowY, const PatchSums& out) {
    const hn::CappedTag<float, kChunk> d;
    std::array<const std::uint8_t*, kRows> rows{};
    Origins origins{};
    Partial partial{};
    const int top = patchStart(cellRow, video.height);
    origins.videoY.fill(static_cast<float>(top));
    for (int row = 0; row < kRows; ++row)
        rows[row] = video.origin + std::min(top + row, video.height - 1) * video.pitch;
    for (int cell = first; cell < last; cell += kChunk) {
        const int count = std::min(kChunk, last - cell);
        for (int i = 0; i < kChunk; ++i)
            origins.videoX[i] = static_cast<float>(patchStart(cell + i, video.width));
        OriginsAlong(d, flowX + cell, origins.videoX.data(), static_cast<float>(still.width - 2),
                     origins.x.data(), origins.fx.data());
        OriginsAlong(d, flowY + cell, origins.videoY.data(), static_cast<float>(still.height - 2),
                     origins.y.data(), origins.fy.data());
        for (int i = 0; i < count; i += kBlocks)
            SumPatches(rows.data(), still, i, count, origins, partial);
        Statistics(d, partial, count, cell, out);
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(ComparePatches);

void comparePatches(const PatchLevel& video, const PatchLevel& still, int cellRow, int first,
                    int last, const float* flowX, const float* flowY, const PatchSums& out) {
    HWY_DYNAMIC_DISPATCH(ComparePatches)(video, still, cellRow, first, last, flowX, flowY, out);
}

}  // namespace mfar::simd
#endif
