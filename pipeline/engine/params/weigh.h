#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// How far the still is trusted, cell by cell: superres_assess.comp, superres_gain.comp,
// superres_weigh.comp and their SIMD twins. Shaders read this header, too:
// gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Two-way error from which on nothing is trusted: eq. 2's alpha [video px].
inline constexpr float kTwoWayAlpha = 2.0F;
/// Farthest offset that is stored [still px].
inline constexpr float kFarthestOffset = 4e3F;

/// Variance of 8-bit steps [grey levels^2].
inline constexpr float kByteVariance = 0.083F;
/// Variance at half resolution, times that of the noise, that counts half.
inline constexpr float kLowContrast = 8.0F;
inline constexpr float kLargestGain = 2.0F;
/// What the bilinear look-up takes from the finest detail.
inline constexpr float kLookUpLoss = 1.15F;
/// Squared correlation of patches that surely differ, and that surely match.
inline constexpr float kUnlikePatches = 0.2F;
inline constexpr float kAlikePatches = 0.6F;
/// Change of the flow per pixel that noise explains, and that makes another view of it.
inline constexpr float kEvenFlow = 0.015F;
inline constexpr float kBentFlow = 0.07F;
/// Change of the flow's step from one cell to the next that a surface may show, and that means two
/// things at different places: between them look-ups lead nowhere [video px].
inline constexpr float kSmoothStep = 1.0F;
inline constexpr float kTornStep = 4.0F;
/// Weights below change nothing that is seen.
inline constexpr float kSmallestWeight = 0.004F;
/// Variance of a textured patch: times that of the noise and of one grey level.
inline constexpr float kTexturedContrast = 8.0F;
/// Squared correlation times confidence of a textured cell that the still does not explain.
inline constexpr float kUnexplainedMatch = 0.25F;

/// The finest detail that the video shows, what pixels differ from the mean of their block of 2x2,
/// is compared with the still's at the same places. A cell keeps its weight as long as the still
/// leaves no more of that detail's variance unexplained than so many times what is usual
/// (FineMatch), which is twice the usual deviation, and beyond that a part of it. Look-ups that are
/// off by a part of a pixel show there alone.
inline constexpr float kFineRoom = 4.0F;
/// Variance below all that counts [grey levels^2].
inline constexpr float kFineLeast = 0.1F;

struct alignas(16) AssessCells {
    Rig rig;
    LumaLevel video, still;  ///< finest levels, both at the video's geometry
    std::int32_t columns, rows;
    std::int32_t backwardColumns, backwardRows;  ///< of the backward field
    std::int32_t forward, backward;              ///< first cells of the fields in patches[]
    std::int32_t errorsGiven;                    ///< 1: two-way errors stand for the backward field
    std::int32_t backwardScale;     ///< video pixels a pixel of the backward field's level
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
    float noise;                         ///< standard deviation of the video's [grey levels]
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
