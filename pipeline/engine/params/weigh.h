#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// Parameters for weighing the still at each cell, in the shaders superres_assess.comp,
// superres_gain.comp and superres_weigh.comp and in the SIMD code. params_to_glsl.cmake translates
// this header to GLSL.
namespace mfar::params {

/// Two-way error above which the confidence is zero [video px]: alpha in eq. 2 of the paper (see
/// docs/paper.md).
inline constexpr float kTwoWayAlpha = 2.0F;
/// Largest absolute value of a look-up offset along each axis [still px]. Larger ones are clamped.
inline constexpr float kFarthestOffset = 4e3F;

/// Variance of the error when a value is rounded to 8 bits [grey levels^2].
inline constexpr float kByteVariance = 0.083F;
/// The photometric gain is also measured at half resolution. If the still's variance there is this
/// multiple of the noise variance, that measurement has half of its full weight.
inline constexpr float kLowContrast = 8.0F;
inline constexpr float kLargestGain = 2.0F;
/// Factor of the still's detail that compensates for the loss in bilinear look-ups.
inline constexpr float kLookUpLoss = 1.15F;
/// Thresholds of the squared correlation of two patches. Up to kUnlikePatches, the patches
/// certainly differ. From kAlikePatches on, they certainly match.
inline constexpr float kUnlikePatches = 0.2F;
inline constexpr float kAlikePatches = 0.6F;
/// Thresholds of the change of the flow [px per px]. Changes up to kEvenFlow are noise. From
/// kBentFlow on, the cameras certainly see the surface from different directions.
inline constexpr float kEvenFlow = 0.015F;
inline constexpr float kBentFlow = 0.07F;
/// Thresholds of the second difference of the flow between neighbouring cells [video px]. Up to
/// kSmoothStep, the cells may show one surface. From kTornStep on, they show different objects, and
/// look-ups between them are invalid.
inline constexpr float kSmoothStep = 1.0F;
inline constexpr float kTornStep = 4.0F;
/// Weights below this have no visible effect.
inline constexpr float kSmallestWeight = 0.004F;
/// A patch is textured if its variance per pixel is at least this multiple of (noise variance + 1)
/// [grey levels^2].
inline constexpr float kTexturedContrast = 8.0F;
/// A textured cell has no reliable match if (squared correlation) * confidence is at most this.
inline constexpr float kUnexplainedMatch = 0.25F;

/// The finest detail consists of the differences between neighbouring pixels. It shows look-up
/// errors of a fraction of a pixel. Its variance is half of the mean squared difference, because
/// white noise then has its usual variance. For each cell, the unexplained variance is measured:
/// the part of the variance of the video's finest detail that the still does not predict.
/// Where the flow is even (see kEvenFlow), cells are hardly misplaced, but noise and detail that
/// aliases in the video remain unexplained. The limit there is kFineRoom * FineMatch::noise +
/// kFineShareRoom * FineMatch::share * (variance of the video's finest detail). Above the limit,
/// the weight of the still is multiplied by limit / (unexplained variance). kFineRoom = 4 allows
/// twice the usual deviation. kFineShareRoom is smaller, because otherwise edges that only the
/// still shows would be accepted.
inline constexpr float kFineRoom = 4.0F;
inline constexpr float kFineShareRoom = 3.0F;
/// Where the flow is bent (see kBentFlow), the still is likely to be misplaced or to show another
/// surface. A misplacement by a normally distributed distance multiplies the correlation at a
/// spatial frequency f by exp(-c * f^2). The still's detail lies an octave above the video's finest
/// detail, so its correlation is the fourth power of that of the video's finest detail. This is the
/// square of the explained share of the variance, and the weight is multiplied by it. Of the
/// unexplained variance, kFineNoise * FineMatch::noise counts as noise and not as unexplained:
/// FineMatch::noise is a low quantile, so most cells have more noise.
inline constexpr float kFineNoise = 2.0F;
/// Variances of the finest detail below this are not significant [grey levels^2].
inline constexpr float kFineLeast = 0.1F;
/// The weight before the comparison of the finest detail is cautious where the flow is bent or
/// patches are unlike. If the finest detail is as usual, a weight w below 1 is raised to
/// w * (kRaisedWeight - w).
inline constexpr float kRaisedWeight = 2.0F;

struct alignas(16) AssessCells {
    Rig rig;
    /// Finest pyramid levels, in the video's geometry.
    LumaLevel video, still;
    std::int32_t columns, rows;
    std::int32_t backwardColumns, backwardRows;
    /// Index in cells[] of the forward field's first cell, and of the backward field's first cell.
    /// If errorsGiven is 1, the two-way errors (ErrorCell) begin at `backward` instead.
    std::int32_t forward, backward;
    std::int32_t errorsGiven;
    /// Video pixels per pixel of the backward field's pyramid level.
    std::int32_t backwardScale;
    float stillWidth, stillHeight;
    float scaleX, scaleY;  ///< still pixels per video pixel
};

struct alignas(16) MeasureGain {
    LumaLevel video, still;
    std::int32_t columns, rows;
    std::int32_t forwardColumns, forwardRows;
    std::int32_t forward;
    std::int32_t tileColumns;
};

struct alignas(16) WeighCells {
    std::int32_t columns, rows;
    std::int32_t halfColumns, halfRows;
    float noise;
};

struct alignas(16) SumFine {
    std::int32_t columns, rows;
    std::int32_t videoWidth, videoHeight;
    float scaleX, scaleY;
    float texelX, texelY;
};

struct alignas(16) ConfirmCells {
    std::int32_t columns, rows;
    float noise, share;  ///< see FineMatch
};

}  // namespace mfar::params
