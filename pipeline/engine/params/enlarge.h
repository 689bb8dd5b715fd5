#pragma once

#include <cstdint>

// Parameters of the learned enlarger (see pipeline/enlarge/filter_layout.h), used by
// superres_enlarge.comp, superres_vertical.frag, learned.glsl and the SIMD code of the same steps.
// gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

inline constexpr int kGrid = 4;  ///< number of sub-pixels of a pixel along each axis
inline constexpr int kGridShift = 2;
static_assert(kGrid == 1 << kGridShift);
inline constexpr int kPairs = 12;  ///< number of pairs of taps in a filter

inline constexpr int kLumaScale = 8;       ///< luma is stored in steps of 1/8 grey level
inline constexpr int kResidualScale = 32;  ///< residuals are stored in steps of 1/32 grey level
/// Shaders store colours and luma between passes in steps of 1/64 grey level.
inline constexpr int kPassScale = 64;

/// Thresholds of GradientClasses: three of the strength [grey levels per px], two of the coherence.
inline constexpr float kWeakFrom = 2.0F;
inline constexpr float kMediumFrom = 6.0F;
inline constexpr float kStrongFrom = 16.0F;
inline constexpr float kPartlyCoherentFrom = 0.25F;
inline constexpr float kCoherentFrom = 0.5F;
/// GradientClasses: number of classes per bin of the angle, and number of bins of the angle.
inline constexpr int kGradientKinds = 12;
inline constexpr int kGradientAngles = 16;

/// Thresholds of CurvatureClasses [grey levels per px^2]: three of the absolute Laplacian, three of
/// the difference of the eigenvalues.
inline constexpr float kLowLaplacian = 2.5F;
inline constexpr float kMediumLaplacian = 8.0F;
inline constexpr float kHighLaplacian = 24.0F;
inline constexpr float kLowDifference = 3.0F;
inline constexpr float kMediumDifference = 10.0F;
inline constexpr float kHighDifference = 25.0F;
inline constexpr int kCurvatureKinds = 28;
inline constexpr int kCurvatureAngles = 8;

/// Tangents of 22.5 and 67.5 degrees. At these values of twice the gradient's angle, two bins meet.
inline constexpr float kLowTangent = 0.414213562F;
inline constexpr float kHighTangent = kLowTangent + 2.0F;

/// The residual is limited so that its sum with Keys' cubic stays within the range of the
/// surrounding 5x5 pixels, extended at both ends by this fraction of the range's width.
inline constexpr float kOvershoot = 0.25F;

struct alignas(16) EnlargeTiles {
    std::int32_t videoWidth, videoHeight;  ///< [px]
    std::int32_t columns, rows;            ///< number of tiles along each axis
    std::int32_t firstColumn, firstRow;    ///< tile where the dispatch starts
};

}  // namespace mfar::params
