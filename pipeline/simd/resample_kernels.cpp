#include "pipeline/simd/resample_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/resample_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;

/// Loads source[index[i]] for ascending indices, which lie in a few adjacent vectors. Permuting
/// these vectors is faster than a gather.
class Window {
public:
    explicit Window(const std::int32_t* first)
        : base_(*first), last_(first[hn::Lanes(I()) - 1] - base_) {
        const I di;
        index_ = hn::Sub(hn::LoadU(di, first), hn::Set(di, base_));
        const auto mask = hn::Set(di, static_cast<std::int32_t>(hn::Lanes(di)) - 1);
        inVector_ = hn::And(index_, mask);
    }

    hn::Vec<F> operator()(const float* source) const {
        const F df;
        const I di;
        const auto lanes = static_cast<std::int32_t>(hn::Lanes(df));
        const auto indices = hn::IndicesFromVec(df, inVector_);
        const float* at = source + base_;
        auto out = hn::TableLookupLanes(hn::LoadU(df, at), indices);
        for (std::int32_t i = lanes; i <= last_; i += lanes) {
            const auto further = hn::TableLookupLanes(hn::LoadU(df, at + i), indices);
            const auto there = hn::RebindMask(df, hn::Gt(index_, hn::Set(di, i - 1)));
            out = hn::IfThenElse(there, further, out);
        }
        return out;
    }

private:
    std::int32_t base_, last_;
    hn::Vec<I> index_, inVector_;
};

template <int kTaps, class Store>
HWY_INLINE void Resample(const float* source, const TapTable& t, int begin, int end,
                         const Store& store) {
    const F df;
    const int lanes = static_cast<int>(hn::Lanes(df));
    const int taps = kTaps > 0 ? kTaps : t.taps;
    for (int x = begin; x < end; x += lanes) {
        const Window window(t.first + x);
        const float* weights = t.weights + x;
        auto sum = hn::Mul(hn::LoadU(df, weights), window(source));
        for (int k = 1; k < taps; ++k)
            sum = hn::MulAdd(hn::LoadU(df, weights + k * t.pitch), window(source + k), sum);
        store(sum, x);
    }
}

template <class Store>
HWY_INLINE void ResampleAny(const float* source, const TapTable& t, int begin, int end,
                            const Store& store) {
    if (t.taps == 4)
        Resample<4>(source, t, begin, end, store);
    else if (t.taps == 2)
        Resample<2>(source, t, begin, end, store);
    else
        Resample<0>(source, t, begin, end, store);
}

void ResampleRow(const float* source, const TapTable& taps, int begin, int end, float* to) {
    const F df;
    ResampleAny(source, taps, begin, end,
                [&](hn::Vec<F> sum, int x) HWY_ATTR { hn::StoreU(sum, df, to + x); });
}

void ResampleRowFixed(const float* source, const TapTable& taps, int begin, int end, float scale,
                      std::int16_t* to) {
    const F df;
    const hn::Rebind<std::int16_t, F> d16;
    const auto by = hn::Set(df, scale);
    ResampleAny(source, taps, begin, end, [&](hn::Vec<F> sum, int x) HWY_ATTR {
        hn::StoreU(hn::DemoteTo(d16, hn::NearestInt(hn::Mul(sum, by))), d16, to + x);
    });
}

void ResampleRowBytes(const float* source, const TapTable& taps, int begin, int end,
                      std::uint8_t* to) {
    const hn::Rebind<std::uint8_t, F> d8;
    ResampleAny(source, taps, begin, end, [&](hn::Vec<F> sum, int x) HWY_ATTR {
        hn::StoreU(hn::DemoteTo(d8, hn::NearestInt(sum)), d8, to + x);
    });
}

template <class T>
HWY_INLINE void SumOfRows(const T* const* rows, const float* weights, int number, int begin,
                          int end, float* to) {
    const F df;
    const I di;
    const hn::Rebind<T, F> narrow;
    const int lanes = static_cast<int>(hn::Lanes(df));
    for (int x = begin; x < end; x += lanes) {
        auto sum = hn::Zero(df);
        for (int i = 0; i < number; ++i) {
            const auto row = hn::ConvertTo(df, hn::PromoteTo(di, hn::LoadU(narrow, rows[i] + x)));
            sum = hn::MulAdd(row, hn::Set(df, weights[i]), sum);
        }
        hn::StoreU(sum, df, to + x);
    }
}

void WeighRows(const std::uint8_t* const* rows, const float* weights, int number, int count,
               float* to) {
    SumOfRows(rows, weights, number, 0, count, to);
}

void WeighRowsFixed(const std::int16_t* const* rows, const float* weights, int number, int begin,
                    int end, float* to) {
    SumOfRows(rows, weights, number, begin, end, to);
}

void WeighRowsAndSquares(const std::int16_t* const* rows, const float* weights, int number,
                         int begin, int end, float* to, float* squares) {
    const F df;
    const I di;
    const hn::Rebind<std::int16_t, F> narrow;
    const int lanes = static_cast<int>(hn::Lanes(df));
    for (int x = begin; x < end; x += lanes) {
        auto sum = hn::Zero(df), square = sum;
        for (int i = 0; i < number; ++i) {
            const auto value = hn::ConvertTo(df, hn::PromoteTo(di, hn::LoadU(narrow, rows[i] + x)));
            const auto weighed = hn::Mul(value, hn::Set(df, weights[i]));
            sum = hn::Add(sum, weighed);
            square = hn::MulAdd(weighed, value, square);
        }
        hn::StoreU(sum, df, to + x);
        hn::StoreU(square, df, squares + x);
    }
}

void MeanOfLightRow(const float* squares, float light, int begin, int end, float* mean) {
    const F df;
    const auto share = hn::Set(df, light);
    const int lanes = static_cast<int>(hn::Lanes(df));
    for (int x = begin; x < end; x += lanes) {
        const auto m = hn::LoadU(df, mean + x);
        const auto root = hn::Sqrt(hn::Max(hn::LoadU(df, squares + x), hn::Zero(df)));
        hn::StoreU(hn::MulAdd(hn::Sub(root, m), share, m), df, mean + x);
    }
}

}  // namespace
}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(ResampleRow);
HWY_EXPORT(ResampleRowFixed);
HWY_EXPORT(ResampleRowBytes);
HWY_EXPORT(WeighRows);
HWY_EXPORT(WeighRowsFixed);
HWY_EXPORT(WeighRowsAndSquares);
HWY_EXPORT(MeanOfLightRow);

void resampleRow(const float* source, const TapTable& taps, int begin, int end, float* to) {
    HWY_DYNAMIC_DISPATCH(ResampleRow)(source, taps, begin, end, to);
}

void resampleRow(const float* source, const TapTable& taps, int begin, int end, float scale,
                 std::int16_t* to) {
    HWY_DYNAMIC_DISPATCH(ResampleRowFixed)(source, taps, begin, end, scale, to);
}

void resampleRow(const float* source, const TapTable& taps, int begin, int end, std::uint8_t* to) {
    HWY_DYNAMIC_DISPATCH(ResampleRowBytes)(source, taps, begin, end, to);
}

void weighRows(const std::int16_t* const* rows, const float* weights, int number, int begin,
               int end, float* to) {
    HWY_DYNAMIC_DISPATCH(WeighRowsFixed)(rows, weights, number, begin, end, to);
}

void weighRows(const std::uint8_t* const* rows, const float* weights, int number, int count,
               float* to) {
    HWY_DYNAMIC_DISPATCH(WeighRows)(rows, weights, number, count, to);
}

void weighRowsAndSquares(const std::int16_t* const* rows, const float* weights, int number,
                         int begin, int end, float* to, float* squares) {
    HWY_DYNAMIC_DISPATCH(WeighRowsAndSquares)(rows, weights, number, begin, end, to, squares);
}

void meanOfLightRow(const float* squares, float light, int begin, int end, float* mean) {
    HWY_DYNAMIC_DISPATCH(MeanOfLightRow)(squares, light, begin, end, mean);
}

}  // namespace mfar::simd
#endif
