#pragma once

#include "base/geometry.h"

#include <array>

namespace mfar::simd {

/// The first or second part of the light of a picture's pixels (see LightPixel), in row-major
/// arrays.
template <class Float>
struct LightPart {
    std::array<Float*, 3> light;
    Float *variance, *count;
};

/// Surfaces that a picture's pixels show, in row-major arrays. Id 0 means no surface. Pixels with
/// `isFixed` above 0 are not changed.
struct LightSurfaces {
    std::array<const float*, 3> normal;
    const float *depth, *id, *isFixed;
};

struct NoiseRule {
    int step;  ///< distance between a pixel and its neighbours [px], at most kNoiseMargin
    /// Largest luminance difference between two pixels that noise explains [standard deviations of
    /// the difference]. It is `catcherTolerance` on surface `catcherId`, else `tolerance`.
    float tolerance, catcherTolerance, catcherId;
    float leastVariance;  ///< added to the variance of each luminance difference
    /// Largest change of depth within a surface [fraction of depth per px], also for `catcherId`.
    float depthSlope, catcherDepthSlope;
};

/// filterNoiseRow() reads up to this number of values before and after each array.
inline constexpr int kNoiseMargin = 8;

/// Row `y` of a picture that is `width` pixels wide; only the columns in `where` are filtered.
/// `from` and `to` must be different arrays. All values in the arrays must be finite.
struct NoiseRow {
    LightSurfaces surfaces;
    std::array<LightPart<const float>, 2> from;
    std::array<LightPart<float>, 2> to;
    PixelRect where;
    int width, y;
};

/// Filters a row of the picture with one level of NoiseFilter's wavelet transform.
void filterNoiseRow(const NoiseRow& row, const NoiseRule& rule);

}  // namespace mfar::simd
