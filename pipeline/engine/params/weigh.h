#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// Parameters for weighing the still at each cell, in the shaders superres_assess.comp,
// superres_gain.comp, superres_weigh.comp, superres_fine.comp, superres_confirm.comp and
// flow_*.comp and in the SIMD code. params_to_glsl.cmake translates this header to GLSL.
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
/// Between two neighbouring cells on different surfaces, the flow jumps. There, look-ups are not
/// interpolated: each output pixel takes the look-up of the nearer cell. The flow jumps if the
/// length of its difference between the two cells exceeds kJump [video px] + kJumpPerChange times
/// the difference between either cell and the next cell beyond it. The second term is needed
/// because the flow also changes on a surface that is seen at a grazing angle, and there
/// interpolation is better.
inline constexpr float kJump = 1.0F;
inline constexpr float kJumpPerChange = 2.0F;
/// LookUpCell::confidenceAndJumps is the confidence, plus kJumpRight if the flow jumps to the right
/// neighbour, plus kJumpBelow if it jumps to the neighbour below.
inline constexpr float kJumpRight = 2.0F;
inline constexpr float kJumpBelow = 4.0F;
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
/// Weights that are computed without the finest detail are cautious where the flow is bent or
/// patches are unlike. Before the finest detail is compared, a weight w below 1 is therefore raised
/// to 1 - (1 - w)^4. The result of the comparison may then lower it.
///
/// On smooth surfaces, look-ups are rarely wrong, but noise and aliasing leave some variance
/// unexplained. The limit there is kFineRoom * FineMatch::noise + kFineShareRoom *
/// FineMatch::share * (variance of the video's finest detail). If the unexplained variance is above
/// the limit, the weight of the still is multiplied by limit / (unexplained variance). kFineRoom =
/// 4 allows twice the usual deviation. kFineShareRoom is smaller, because edges that only the still
/// shows must not be accepted.
inline constexpr float kFineRoom = 4.0F;
inline constexpr float kFineShareRoom = 3.0F;
/// A rough texture, such as grass, aliases in the video: much of its finest detail cannot be
/// predicted, although the look-ups are right. Roughness is the variance of the video's finest
/// detail, divided by the variance of all pixels around the cell. It is 1 for white noise and about
/// 0.2 for an edge between two uniform areas. Up to a roughness of kFineTexture, the limit of the
/// unexplained variance (see kFineRoom) applies fully. From kRoughTexture on, there is no limit.
inline constexpr float kFineTexture = 0.2F;
inline constexpr float kRoughTexture = 0.4F;
/// Where a surface has an edge, look-ups are probably wrong or show another surface. There, the
/// flow has a kink: it is bent (see kBentFlow) and has a large second difference between
/// neighbouring cells [video px]. Up to a second difference of kFlatKink, the surface is smooth;
/// from kSharpKink on, it certainly has an edge. The second difference is needed because a flat
/// surface that is seen at a grazing angle has bent flow, too.
///
/// The flow of rough textures that alias varies from cell to cell. There, kFlatRoughKink and
/// kSharpRoughKink take the place of both limits. A rough texture aliases if the finest detail of
/// the still, averaged over the video's pixels, has less variance than that of the video. Up to a
/// ratio of kAliasedStill, it certainly aliases. From kDetailedStill on, the still probably shows
/// an edge that the video does not show.
///
/// At an edge, the weight is multiplied by the fourth power of the explained share of the variance
/// of the video's finest detail. Reason: look-up errors with a normal distribution multiply the
/// correlation at a spatial frequency f by exp(-c * f^2), and the explained share is the square of
/// the correlation at the video's finest detail. The middle of the still's detail lies one and a
/// half octaves above that: f^2 is eight times as large, so the correlation there is the fourth
/// power of the explained share.
///
/// kFineNoise * FineMatch::noise is first subtracted from the unexplained variance as noise.
/// FineMatch::noise is a low quantile, so most cells have more noise than this; kFineNoise makes up
/// for that.
inline constexpr float kFlatKink = 0.1F;
inline constexpr float kSharpKink = 0.4F;
inline constexpr float kFlatRoughKink = 1.5F;
inline constexpr float kSharpRoughKink = 3.0F;
inline constexpr float kAliasedStill = 0.4F;
inline constexpr float kDetailedStill = 0.7F;
inline constexpr float kFineNoise = 2.0F;
/// A variance of the finest detail below this is too small to count [grey levels^2].
inline constexpr float kFineLeast = 0.1F;

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
