#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// Parameters for weighing the still at each cell, in the shaders superres_assess.comp,
// superres_gain.comp and superres_weigh.comp and in the SIMD code. params_to_glsl.cmake translates
// this header to GLSL.
namespace mfar::params {

/// Where the two-way error exceeds this [video px], the confidence is zero. It is alpha in eq. 2 of
/// the paper (docs/paper.md).
inline constexpr float kTwoWayAlpha = 2.0F;
/// Largest absolute value of a look-up offset along each axis [still px]. Larger ones are clamped.
inline constexpr float kFarthestOffset = 4e3F;

/// Variance of the error when a value is rounded to 8 bits [grey levels^2].
inline constexpr float kByteVariance = 0.083F;
/// The photometric gain is measured at full and at half resolution. The weight of the measurement
/// at half resolution depends on the still's variance there. If this variance is kLowContrast times
/// the noise variance, the weight is half of its maximum.
inline constexpr float kLowContrast = 8.0F;
inline constexpr float kLargestGain = 2.0F;
/// The still's detail is multiplied by this factor, because bilinear look-ups weaken it.
inline constexpr float kLookUpLoss = 1.15F;
/// Two patches certainly differ if their squared correlation is at most kUnlikePatches. They
/// certainly match if it is at least kAlikePatches.
inline constexpr float kUnlikePatches = 0.2F;
inline constexpr float kAlikePatches = 0.6F;
/// Limits of the change of the flow [px per px]. A change of up to kEvenFlow is noise. From
/// kBentFlow on, the two cameras certainly see the surface from different directions.
inline constexpr float kEvenFlow = 0.015F;
inline constexpr float kBentFlow = 0.07F;
/// Limits of the second difference of the flow between neighbouring cells [video px]. Up to
/// kSmoothStep, the cells may show one surface. From kTornStep on, they show different objects, and
/// interpolating between their flow vectors gives wrong positions.
inline constexpr float kSmoothStep = 2.0F;
inline constexpr float kTornStep = 8.0F;
/// Weights below this have no visible effect.
inline constexpr float kSmallestWeight = 0.004F;
/// A patch is textured if the variance of its pixels is at least this factor times (noise variance
/// + 1) [grey levels^2].
inline constexpr float kTexturedContrast = 8.0F;
/// A textured cell has no reliable match if (squared correlation) * confidence is at most this.
inline constexpr float kUnexplainedMatch = 0.25F;

/// The finest detail of a picture is the difference between neighbouring pixels. Its variance is
/// half of the mean squared difference, which for white noise is the variance of the noise. The
/// finest detail reveals look-ups that are wrong by a fraction of a pixel. The unexplained variance
/// of a cell is the part of the variance of the video's finest detail that the still does not
/// predict.
///
/// Where the flow is even (see kEvenFlow), look-ups are rarely wrong, but noise and aliasing leave
/// some variance unexplained. The limit there is kFineRoom * FineMatch::noise + kFineShareRoom *
/// FineMatch::share * (variance of the video's finest detail). If the unexplained variance is above
/// the limit, the weight of the still is multiplied by limit / (unexplained variance). kFineRoom =
/// 4 allows twice the usual deviation. kFineShareRoom is smaller, because edges that only the still
/// shows must not be accepted.
inline constexpr float kFineRoom = 4.0F;
inline constexpr float kFineShareRoom = 3.0F;
/// Where the flow is bent (see kBentFlow), look-ups are probably wrong or show another surface.
/// There, the weight is multiplied by the square of the explained share of the variance of the
/// video's finest detail. Reason: look-up errors with a normal distribution multiply the
/// correlation at a spatial frequency f by exp(-c * f^2). The still's detail lies an octave above
/// the video's finest detail, so its correlation is the fourth power of the correlation there. The
/// explained share is the square of that correlation.
///
/// kFineNoise * FineMatch::noise is first subtracted from the unexplained variance as noise.
/// FineMatch::noise is a low quantile, so most cells have more noise than this; kFineNoise makes up
/// for that.
inline constexpr float kFineNoise = 2.0F;
/// A variance of the finest detail below this is too small to count [grey levels^2].
inline constexpr float kFineLeast = 0.1F;
/// Weights that are computed without the finest detail are cautious where the flow is bent or
/// patches are unlike. Once the finest detail is compared, a weight w below 1 can be raised to w *
/// (kRaisedWeight - w). The result of the comparison may then lower it.
inline constexpr float kRaisedWeight = 2.0F;

struct alignas(16) AssessCells {
    Rig rig;
    /// Finest pyramid levels, in the video's geometry.
    LumaLevel video, still;
    std::int32_t columns, rows;
    std::int32_t backwardColumns, backwardRows;
    /// `forward`: index in cells[] of the forward field's first cell. `backward`: index of the
    /// backward field's first cell. If errorsGiven is 1, there is no backward field, and the
    /// two-way errors (ErrorCell) begin at `backward`.
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
