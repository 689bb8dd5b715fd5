#pragma once

#include <cstdint>

// Parameters of the learned enlarger (see filter_layout.h) in the shaders superres_enlarge.comp,
// superres_seen.frag, superres_vertical.frag, enlarge_classes.glsl and learned.glsl and in the SIMD
// code. params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

inline constexpr int kGrid = 4;  ///< number of sub-pixels of a pixel along each axis
inline constexpr int kGridShift = 2;
static_assert(kGrid == 1 << kGridShift);
inline constexpr int kPairs = 12;  ///< number of pairs of taps in a filter

/// Luma is stored in steps of 1/8 grey level, and residuals in steps of 1/32.
inline constexpr int kLumaScale = 8;
inline constexpr int kResidualScale = 32;
/// superres_seen.frag and superres_vertical.frag store luma, colours, the guidance signal and
/// residuals in steps of 1/64 grey level.
inline constexpr int kPassScale = 64;

/// Borders between GradientClasses: three for the strength [grey levels per px], two for the
/// coherence.
inline constexpr float kWeakFrom = 2.0F;
inline constexpr float kMediumFrom = 6.0F;
inline constexpr float kStrongFrom = 16.0F;
inline constexpr float kPartlyCoherentFrom = 0.25F;
inline constexpr float kCoherentFrom = 0.5F;
/// Number of GradientClasses with the same angle, and number of angles.
inline constexpr int kGradientKinds = 12;
inline constexpr int kGradientAngles = 16;

/// Borders between CurvatureClasses [grey levels per px^2]: three for the absolute Laplacian, three
/// for the difference of the eigenvalues.
inline constexpr float kLowLaplacian = 2.5F;
inline constexpr float kMediumLaplacian = 8.0F;
inline constexpr float kHighLaplacian = 24.0F;
inline constexpr float kLowDifference = 3.0F;
inline constexpr float kMediumDifference = 10.0F;
inline constexpr float kHighDifference = 25.0F;
inline constexpr int kCurvatureKinds = 28;
inline constexpr int kCurvatureAngles = 8;

/// A pixel's class depends on the angle of its gradient. To sort the angle into a bin, twice the
/// angle is compared with the borders between bins. kLowTangent and kHighTangent are the tangents
/// of two borders: 22.5 and 67.5 degrees.
inline constexpr float kLowTangent = 0.414213562F;
inline constexpr float kHighTangent = kLowTangent + 2.0F;

/// The enlarged value (Keys' cubic plus the residual) is clamped to the range of the surrounding
/// 5x5 pixels, extended at both ends by this fraction of the range's width.
inline constexpr float kOvershoot = 0.25F;

struct alignas(16) EnlargeTiles {
    std::int32_t videoWidth, videoHeight;
    std::int32_t columns, rows;
    std::int32_t firstColumn, firstRow;  ///< tile of the dispatch's first workgroup
};

}  // namespace mfar::params
