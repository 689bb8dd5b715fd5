#include "pipeline/simd/depth_samples.h"

#include "pipeline/engine/params/occlusion.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/depth_samples.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kNowhere = -1e9F;  // inverse depth of unknown pixels, which occlude nothing [1/m]

struct Prepare {
    const SampleSource& from;
    const SampleBounds& bounds;
    const SampleRow& to;

    template <class D>
    HWY_INLINE void operator()(D d, int x) const {
        using V = hn::Vec<D>;
        const V zero = hn::Zero(d);
        const V inverse = hn::LoadU(d, from.inverse + x), given = hn::LoadU(d, from.sigma + x);
        const V sigma = from.squared ? hn::Sqrt(given) : given;
        // A sample with NaN is unknown, because every comparison with NaN is false.
        const auto near = hn::And(hn::Gt(inverse, hn::Set(d, params::kLeastInverseDepth)),
                                  hn::Lt(inverse, hn::Set(d, params::kMostInverseDepth)));
        const auto sharp = hn::And(hn::Gt(sigma, hn::Set(d, params::kLeastDepthSigma)),
                                   hn::Lt(sigma, hn::Set(d, params::kMostInverseDepth)));
        const auto known = hn::And(near, sharp);
        const V front = hn::NegMulAdd(hn::Set(d, bounds.bias), sigma, inverse);
        const V behind = hn::NegMulAdd(hn::Set(d, bounds.hidden), sigma, inverse);
        hn::StoreU(hn::IfThenElse(known, inverse, hn::Set(d, kNowhere)), d, to.inverse + x);
        hn::StoreU(hn::IfThenElse(known, hn::Mul(sigma, sigma), hn::Set(d, 1.0F)), d,
                   to.variance + x);
        hn::StoreU(hn::IfThenElseZero(known, hn::Max(front, zero)), d, to.nearest + x);
        hn::StoreU(hn::IfThenElseZero(known, hn::Max(behind, zero)), d, to.farthest + x);
        colour(d, from.red + x, to.red + x);
        colour(d, from.green + x, to.green + x);
        colour(d, from.blue + x, to.blue + x);
    }

private:
    template <class D>
    HWY_INLINE void colour(D d, const std::uint8_t* bytes, float* floats) const {
        const hn::Rebind<std::uint8_t, D> d8;
        const hn::RebindToSigned<D> di;
        hn::StoreU(hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(d8, bytes))), d, floats);
    }
};

template <class Body>
HWY_INLINE void Along(int first, int last, const Body& body) {
    const hn::ScalableTag<float> d;
    const hn::CappedTag<float, 1> one;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int x = first;
    for (; x + lanes <= last; x += lanes)
        body(d, x);
    for (; x < last; ++x)
        body(one, x);
}

void PrepareSamples(const SampleSource& from, const SampleBounds& bounds, int first, int last,
                    const SampleRow& to) {
    Along(first, last, Prepare{from, bounds, to});
}

struct Spread {
    float *nearest, *farthest;

    template <class D>
    HWY_INLINE void operator()(D d, int x) const {
        const auto n = [&](int i) HWY_ATTR { return hn::LoadU(d, nearest + x + i); };
        const auto f = [&](int i) HWY_ATTR { return hn::LoadU(d, farthest + x + i); };
        const auto most = hn::Max(hn::Max(n(0), n(1)), hn::Max(n(2), n(3)));
        const auto least = hn::Min(hn::Min(f(0), f(1)), hn::Min(f(2), f(3)));
        hn::StoreU(most, d, nearest + x);
        hn::StoreU(least, d, farthest + x);
    }
};

void SpreadSamples(float* nearest, float* farthest, int count) {
    Along(0, count, Spread{nearest, farthest});
}

struct Range {
    const FourRows &nearest, &farthest;
    float *greatest, *least;

    template <class D>
    HWY_INLINE void operator()(D d, int x) const {
        const auto n = [&](int i) HWY_ATTR { return hn::LoadU(d, nearest.row[i] + x); };
        const auto f = [&](int i) HWY_ATTR { return hn::LoadU(d, farthest.row[i] + x); };
        hn::StoreU(hn::Max(hn::Max(n(0), n(1)), hn::Max(n(2), n(3))), d, greatest + x);
        hn::StoreU(hn::Min(hn::Min(f(0), f(1)), hn::Min(f(2), f(3))), d, least + x);
    }
};

void RangeOfSamples(const FourRows& nearest, const FourRows& farthest, int count, float* greatest,
                    float* least) {
    Along(0, count, Range{nearest, farthest, greatest, least});
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(PrepareSamples);
HWY_EXPORT(SpreadSamples);
HWY_EXPORT(RangeOfSamples);

void prepareSamples(const SampleSource& from, const SampleBounds& bounds, int first, int last,
                    const SampleRow& to) {
    HWY_DYNAMIC_DISPATCH(PrepareSamples)(from, bounds, first, last, to);
}

void spreadSamples(float* nearest, float* farthest, int count) {
    HWY_DYNAMIC_DISPATCH(SpreadSamples)(nearest, farthest, count);
}

void rangeOfSamples(const FourRows& nearest, const FourRows& farthest, int count, float* greatest,
                    float* least) {
    HWY_DYNAMIC_DISPATCH(RangeOfSamples)(nearest, farthest, count, greatest, least);
}

}  // namespace mfar::simd
#endif
