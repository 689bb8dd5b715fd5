#pragma once

namespace mfar {

// Parameters of the 2-D flow that are no options, for both engines.

/// With the last frame's field among the candidates only what moved on its own needs a search.
inline constexpr int kTrackingRadius = 3;
/// Of tiles off their epipolar lines: 5 px are 80 px of the frame; what moved farther since the
/// still is not worth four times the search.
inline constexpr int kListedRadius = 5;
/// Gauss-Newton steps after a neighbour's vector fitted better.
inline constexpr int kPropagateSteps = 2;
/// From a vector that is right but for a fraction of a pixel; four gain nothing.
inline constexpr int kAlignSteps = 2;
/// The backward field only confirms: a tenth of a coarser level's pixel is a tenth of eq. 2's
/// alpha.
inline constexpr int kBackwardFinest = 1;
inline constexpr int kBackwardPropagations = 1;

/// Energy of an 8x8 patch [grey levels^2] from which on its cost says something: eight times that
/// of a grey level of noise.
inline constexpr double kTexturePerVariance = 8 * 64;
inline constexpr float kUnexplainedCost = 0.4F;
/// Two-way error [px] of cells that the still cannot show. What lies behind something else is
/// searched: what moves hides and is hidden, and the z-test believes the lines.
inline constexpr float kNotShown = 100;
/// Unexplained cells of a tile that is searched, of 16.
inline constexpr int kLeastUnexplained = 3;

}  // namespace mfar
