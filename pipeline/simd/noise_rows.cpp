#include "pipeline/simd/noise_rows.h"

#include <cstddef>
#include <cstdlib>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/noise_rows.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

// Weights of the pixel and of its neighbours at a distance of NoiseRule::step. A second neighbour
// on each side would double the time without a better result (measured at 1 to 64 samples per
// pixel).
constexpr std::array<float, 2> kSpline = {0.5F, 0.25F};

/// Luminance of linear RGB (see base/luminance.h).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V luminance(D d, V r, V g, V b) {
    return hn::MulAdd(hn::Set(d, 0.2126F), r,
                      hn::MulAdd(hn::Set(d, 0.7152F), g, hn::Mul(hn::Set(d, 0.0722F), b)));
}

/// The weighted mean of a LightPart over a pixel and its neighbours. If the pixel has samples, a
/// neighbour's weight falls with the difference in luminance, and is 0 if the difference is larger
/// than noise explains.
template <class D>
class PartMean {
public:
    using V = hn::Vec<D>;

    HWY_INLINE PartMean(D d, const LightPart<const float>& from, std::ptrdiff_t centre,
                        V tolerance2)
        : d_(d), from_(from), centre_(centre), tolerance2_(tolerance2),
          variance_(hn::LoadU(d, from.variance + centre)),
          isKnown_(hn::Gt(hn::LoadU(d, from.count + centre), hn::Zero(d))) {
        for (std::size_t c = 0; c < 3; ++c) {
            light_[c] = hn::LoadU(d, from.light[c] + centre);
            sum_[c] = hn::Zero(d);
        }
        weights_ = variances_ = hn::Zero(d);
    }

    HWY_INLINE void add(std::ptrdiff_t i, V weight, V leastVariance) {
        const V variance = hn::LoadU(d_, from_.variance + i);
        std::array<V, 3> light;
        for (std::size_t c = 0; c < 3; ++c)
            light[c] = hn::LoadU(d_, from_.light[c] + i);
        const V off = luminance(d_, hn::Sub(light[0], light_[0]), hn::Sub(light[1], light_[1]),
                                hn::Sub(light[2], light_[2]));
        const V noise = hn::Add(hn::Add(variance_, variance), leastVariance);
        const V unlike = hn::Div(hn::Mul(off, off), hn::Mul(tolerance2_, noise));
        const V likeness = hn::ZeroIfNegative(hn::Sub(hn::Set(d_, 1), unlike));
        weight = hn::IfThenElse(isKnown_, hn::Mul(weight, hn::Mul(likeness, likeness)), weight);
        const auto isSampled = hn::Gt(hn::LoadU(d_, from_.count + i), hn::Zero(d_));
        weight = hn::IfThenElseZero(isSampled, weight);
        for (std::size_t c = 0; c < 3; ++c)
            sum_[c] = hn::MulAdd(weight, light[c], sum_[c]);
        variances_ = hn::MulAdd(hn::Mul(weight, weight), variance, variances_);
        weights_ = hn::Add(weights_, weight);
    }

    template <class Mask>
    HWY_INLINE void store(Mask isFixed, const LightPart<float>& to) const {
        const auto changes = hn::AndNot(isFixed, hn::Gt(weights_, hn::Zero(d_)));
        const V weights = hn::IfThenElse(changes, weights_, hn::Set(d_, 1));
        const V inverse = hn::Div(hn::Set(d_, 1), weights);
        for (std::size_t c = 0; c < 3; ++c)
            hn::StoreU(hn::IfThenElse(changes, hn::Mul(sum_[c], inverse), light_[c]), d_,
                       to.light[c] + centre_);
        hn::StoreU(
            hn::IfThenElse(changes, hn::Mul(variances_, hn::Mul(inverse, inverse)), variance_), d_,
            to.variance + centre_);
        const V count = hn::LoadU(d_, from_.count + centre_);
        hn::StoreU(hn::IfThenElse(changes, hn::Max(count, hn::Set(d_, 1)), count), d_,
                   to.count + centre_);
    }

private:
    D d_;
    const LightPart<const float>& from_;
    std::ptrdiff_t centre_;
    V tolerance2_, variance_;
    hn::Mask<D> isKnown_;
    std::array<V, 3> light_, sum_;
    V weights_, variances_;
};

template <class D>
class SameSurface {
public:
    using V = hn::Vec<D>;

    HWY_INLINE SameSurface(D d, const LightSurfaces& surfaces, std::ptrdiff_t centre,
                           const NoiseRule& rule)
        : d_(d), surfaces_(surfaces), depth_(hn::LoadU(d, surfaces.depth + centre)),
          id_(hn::LoadU(d, surfaces.id + centre)) {
        const auto ofCatcher = hn::Eq(id_, hn::Set(d, rule.catcherId));
        slope_ = hn::Mul(depth_, hn::IfThenElse(ofCatcher, hn::Set(d, rule.catcherDepthSlope),
                                                hn::Set(d, rule.depthSlope)));
        for (std::size_t c = 0; c < 3; ++c)
            normal_[c] = hn::LoadU(d, surfaces.normal[c] + centre);
    }

    /// Returns the weight of the neighbours from index `i` on, `away` pixels away. It is the eighth
    /// power of the cosine of the angle between both pixels' normals (1/2 at 24 degrees), or 0 if
    /// the two pixels show different surfaces.
    HWY_INLINE V weight(std::ptrdiff_t i, int away) const {
        const V depth = hn::LoadU(d_, surfaces_.depth + i), id = hn::LoadU(d_, surfaces_.id + i);
        const V slope = hn::Mul(hn::Set(d_, static_cast<float>(away)), slope_);
        const auto isSame =
            hn::And(hn::Eq(id, id_), hn::Le(hn::Abs(hn::Sub(depth, depth_)), slope));
        V cosine = hn::Zero(d_);
        for (std::size_t c = 0; c < 3; ++c)
            cosine = hn::MulAdd(normal_[c], hn::LoadU(d_, surfaces_.normal[c] + i), cosine);
        cosine = hn::ZeroIfNegative(cosine);
        const V second = hn::Mul(cosine, cosine), fourth = hn::Mul(second, second);
        return hn::IfThenElseZero(isSame, hn::Mul(fourth, fourth));
    }
    [[nodiscard]] HWY_INLINE V id() const { return id_; }

private:
    D d_;
    const LightSurfaces& surfaces_;
    V depth_, id_, slope_;
    std::array<V, 3> normal_;
};

template <class D>
HWY_INLINE hn::Vec<D> squaredTolerance(D d, const NoiseRule& rule, hn::Vec<D> id) {
    const auto isCatcher = hn::Eq(id, hn::Set(d, rule.catcherId));
    const auto tolerance =
        hn::IfThenElse(isCatcher, hn::Set(d, rule.catcherTolerance), hn::Set(d, rule.tolerance));
    return hn::Mul(tolerance, tolerance);
}

/// Calls use(index, weight) for a vector of pixels that begins at column `x`, and for each of the
/// eight vectors of neighbours around it.
template <class D, class Use>
HWY_INLINE void forNeighbours(D d, const NoiseRow& row, int step, const SameSurface<D>& surface,
                              int x, const Use& use) {
    const auto set = [d](int v) HWY_ATTR { return hn::Set(d, static_cast<float>(v)); };
    for (int dy = -1; dy <= 1; ++dy) {
        const int y = row.y + dy * step;
        if (y < row.where.y0 || y >= row.where.y1) continue;
        for (int dx = -1; dx <= 1; ++dx) {
            const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(y) * row.width + (x + dx * step);
            const auto column = hn::Add(hn::Iota(d, 0), set(x + dx * step));
            const auto isInside =
                hn::And(hn::Ge(column, set(row.where.x0)), hn::Lt(column, set(row.where.x1)));
            const bool isCentre = dx == 0 && dy == 0;
            const auto like = isCentre ? set(1) : surface.weight(i, step);
            const float spline = kSpline[std::abs(dx)] * kSpline[std::abs(dy)];
            use(i, hn::IfThenElseZero(isInside, hn::Mul(hn::Set(d, spline), like)));
        }
    }
}

void FilterNoiseRow(const NoiseRow& row, const NoiseRule& rule) {
    const auto count = static_cast<std::size_t>(row.where.x1 - row.where.x0);
    forLanes(hn::ScalableTag<float>(), count, [&](auto d, std::size_t first) HWY_ATTR {
        using D = decltype(d);
        const int x = row.where.x0 + static_cast<int>(first);
        const std::ptrdiff_t centre = static_cast<std::ptrdiff_t>(row.y) * row.width + x;
        const SameSurface<D> surface(d, row.surfaces, centre, rule);
        const auto tolerance2 = squaredTolerance(d, rule, surface.id());
        const auto leastVariance = hn::Set(d, rule.leastVariance);
        PartMean<D> a(d, row.from[0], centre, tolerance2), b(d, row.from[1], centre, tolerance2);
        forNeighbours(d, row, rule.step, surface, x,
                      [&](std::ptrdiff_t i, hn::Vec<D> weight) HWY_ATTR {
                          a.add(i, weight, leastVariance);
                          b.add(i, weight, leastVariance);
                      });
        const auto zero = hn::Zero(d);
        const auto isFixed = hn::Or(hn::Gt(hn::LoadU(d, row.surfaces.isFixed + centre), zero),
                                    hn::Eq(surface.id(), zero));
        a.store(isFixed, row.to[0]);
        b.store(isFixed, row.to[1]);
    });
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(FilterNoiseRow);

void filterNoiseRow(const NoiseRow& row, const NoiseRule& rule) {
    HWY_DYNAMIC_DISPATCH(FilterNoiseRow)(row, rule);
}

}  // namespace mfar::simd
#endif
