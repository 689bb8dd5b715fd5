#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// How far the still is trusted, cell by cell: superres_assess.comp, superres_gain.comp,
// superres_weigh.comp and their SIMD twins. Shaders read this header, too:
// gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Two-way error above which the confidence is zero: eq. 2's alpha [video px].
inline constexpr float kTwoWayAlpha = 2.0F;
/// Upper limit of stored offsets [still px].
inline constexpr float kFarthestOffset = 4e3F;

/// Variance of rounding to 8 bits [grey levels^2].
inline constexpr float kByteVariance = 0.083F;
/// Ratio of variance to noise variance at which the half resolution has half of its full weight.
inline constexpr float kLowContrast = 8.0F;
inline constexpr float kLargestGain = 2.0F;
/// Compensates the loss of the finest detail in bilinear look-ups.
inline constexpr float kLookUpLoss = 1.15F;
/// Squared correlation up to which patches certainly differ, and from which they certainly match.
inline constexpr float kUnlikePatches = 0.2F;
inline constexpr float kAlikePatches = 0.6F;
/// Change of the flow per pixel that noise explains, and from which the surface is seen from
/// another side.
inline constexpr float kEvenFlow = 0.015F;
inline constexpr float kBentFlow = 0.07F;
/// Second difference of the flow from cell to cell that a surface may have, and from which two
/// cells show different objects, so that look-ups between them are invalid [video px].
inline constexpr float kSmoothStep = 1.0F;
inline constexpr float kTornStep = 4.0F;
/// Smaller weights have no visible effect.
inline constexpr float kSmallestWeight = 0.004F;
/// Lower limit of a textured patch's variance, as a multiple of the variance of noise plus one grey
/// level.
inline constexpr float kTexturedContrast = 8.0F;
/// A textured cell is unexplained up to this squared correlation times confidence.
inline constexpr float kUnexplainedMatch = 0.25F;

/// The finest detail is the difference of pixels from the mean of their 2x2 block. The video's is
/// compared with the still's at the same place, because only there look-up errors of a fraction of
/// a pixel are visible. A cell keeps its weight while the variance that the still leaves
/// unexplained is at most kFineRoom times the usual noise plus kFineShareRoom times the usual share
/// of the detail's variance (FineMatch). Above that, the weight is multiplied by allowed /
/// unexplained. 4 is twice the usual deviation; the factor of the share is smaller, because
/// otherwise edges that only the still shows would pass.
inline constexpr float kFineRoom = 4.0F;
inline constexpr float kFineShareRoom = 3.0F;
/// Step between sampled rows of cells; the rows between take the mean of both neighbours.
inline constexpr int kFineStep = 2;
/// Lower limit of variances that are taken into account [grey levels^2].
inline constexpr float kFineLeast = 0.1F;

struct alignas(16) AssessCells {
    Rig rig;
    LumaLevel video, still;  ///< finest levels, both in the video's geometry
    std::int32_t columns, rows;
    std::int32_t backwardColumns, backwardRows;  ///< of the backward field
    std::int32_t forward, backward;              ///< first cells of both fields in patches[]
    std::int32_t errorsGiven;                    ///< 1: errors replace the backward field
    std::int32_t backwardScale;     ///< video pixels per pixel of the backward field's level
    float stillWidth, stillHeight;  ///< [px]
    float scaleX, scaleY;           ///< still pixels per video pixel
};

struct alignas(16) MeasureGain {
    LumaLevel video, still;      ///< second levels
    std::int32_t columns, rows;  ///< of half-resolution cells
    std::int32_t forwardColumns, forwardRows;
    std::int32_t forward;  ///< first cell of the field in patches[]
    std::int32_t tileColumns;
};

struct alignas(16) WeighCells {
    std::int32_t columns, rows;
    std::int32_t halfColumns, halfRows;  ///< of half-resolution cells
    float noise;                         ///< standard deviation of the video's noise [grey levels]
};

struct alignas(16) SumFine {
    std::int32_t columns, rows;            ///< of cells
    std::int32_t videoWidth, videoHeight;  ///< [px]
    float scaleX, scaleY;                  ///< still pixels per video pixel
    float texelX, texelY;                  ///< 1 / size of the still [1/px]
};

struct alignas(16) ConfirmCells {
    std::int32_t columns, rows;  ///< of cells
    float noise, share;          ///< FineMatch
};

}  // namespace mfar::params
