#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// Parameters for weighing the still at each cell, used by superres_assess.comp, superres_gain.comp,
// superres_weigh.comp and the SIMD code of the same steps. gles_shaders/params_to_glsl.cmake
// translates this header for the shaders.
namespace mfar::params {

/// Two-way error above which the confidence is zero: alpha in eq. 2 of the paper [video px].
inline constexpr float kTwoWayAlpha = 2.0F;
/// Largest look-up offset that is stored [still px]; larger ones are clamped.
inline constexpr float kFarthestOffset = 4e3F;

/// Variance of the error of rounding to 8 bits [grey levels^2].
inline constexpr float kByteVariance = 0.083F;
/// Ratio of the still's variance to the variance of the noise at which the gain measured at half
/// resolution has half of its full weight.
inline constexpr float kLowContrast = 8.0F;
inline constexpr float kLargestGain = 2.0F;
/// Factor by which the still's detail is amplified, to compensate for the loss in bilinear
/// look-ups.
inline constexpr float kLookUpLoss = 1.15F;
/// Thresholds for the squared correlation of two patches: up to kUnlikePatches they certainly
/// differ, from kAlikePatches on they certainly match.
inline constexpr float kUnlikePatches = 0.2F;
inline constexpr float kAlikePatches = 0.6F;
/// Thresholds for the change of the flow [px per px]: up to kEvenFlow, noise explains it; from
/// kBentFlow on, the two cameras see the surface from different directions.
inline constexpr float kEvenFlow = 0.015F;
inline constexpr float kBentFlow = 0.07F;
/// Thresholds for the second difference of the flow between neighbouring cells [video px]: up to
/// kSmoothStep, the cells may show one surface. From kTornStep on, they show different objects, and
/// look-ups between them are invalid.
inline constexpr float kSmoothStep = 1.0F;
inline constexpr float kTornStep = 4.0F;
/// Weights below this have no visible effect.
inline constexpr float kSmallestWeight = 0.004F;
/// A patch is textured if its variance per pixel is at least this factor times (variance of the
/// noise + 1) [grey levels^2].
inline constexpr float kTexturedContrast = 8.0F;
/// A textured cell is unexplained if its squared correlation times its confidence is at most this
/// value.
inline constexpr float kUnexplainedMatch = 0.25F;

/// The finest detail is the difference of pixels from the mean of their 2x2 block. The video's
/// finest detail is compared with the still's at the same position, because only this comparison
/// shows look-up errors of a fraction of a pixel. The comparison determines the variance that the
/// still leaves unexplained. A cell keeps its weight while this variance is at most kFineRoom times
/// the usual noise plus kFineShareRoom times the usual share of the detail's variance (FineMatch).
/// Above this limit, the weight is multiplied by limit / variance. kFineRoom = 4 allows twice the
/// usual deviation. kFineShareRoom is smaller, because otherwise edges that only the still shows
/// would be accepted.
inline constexpr float kFineRoom = 4.0F;
inline constexpr float kFineShareRoom = 3.0F;
/// Only every kFineStep-th row of cells is sampled. The rows between take the mean of both
/// neighbours.
inline constexpr int kFineStep = 2;
/// Variances of the finest detail below this value are not significant [grey levels^2].
inline constexpr float kFineLeast = 0.1F;

struct alignas(16) AssessCells {
    Rig rig;
    LumaLevel video, still;  ///< finest pyramid levels, both in the video's geometry
    std::int32_t columns, rows;
    std::int32_t backwardColumns, backwardRows;  ///< size of the backward field
    std::int32_t forward, backward;              ///< index of the first cell of each field in
                                                 ///< cells[]
    std::int32_t errorsGiven;                    ///< 1: `backward` is a field of two-way errors
    std::int32_t backwardScale;     ///< video pixels per pixel of the backward field's pyramid
                                    ///< level
    float stillWidth, stillHeight;  ///< [px]
    float scaleX, scaleY;           ///< still pixels per video pixel
};

struct alignas(16) MeasureGain {
    LumaLevel video, still;      ///< second pyramid levels of both pictures
    std::int32_t columns, rows;  ///< number of half-resolution cells
    std::int32_t forwardColumns, forwardRows;
    std::int32_t forward;  ///< index in cells[] of the forward field's first cell
    std::int32_t tileColumns;
};

struct alignas(16) WeighCells {
    std::int32_t columns, rows;
    std::int32_t halfColumns, halfRows;  ///< number of half-resolution cells
    float noise;                         ///< standard deviation of the video's noise [grey levels]
};

struct alignas(16) SumFine {
    std::int32_t columns, rows;            ///< number of cells
    std::int32_t videoWidth, videoHeight;  ///< [px]
    float scaleX, scaleY;                  ///< still pixels per video pixel
    float texelX, texelY;                  ///< 1 / size of the still [1/px]
};

struct alignas(16) ConfirmCells {
    std::int32_t columns, rows;  ///< number of cells
    float noise, share;          ///< variance that the still is expected to leave unexplained; see
                                 ///< FineMatch
};

}  // namespace mfar::params
