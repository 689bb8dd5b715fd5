#pragma once

#include "pipeline/engine/params/enlarge.h"

#include <array>
#include <cstddef>
#include <cstdint>

/// Definitions shared by the learned enlarger, its trainer and its tests. The method follows RAISR
/// (Romano, Isidoro, Milanfar, 2017). Each pixel of the luma is enlarged to 4x4 sub-pixels. A
/// sub-pixel is the sum of Keys' cubic enlargement and a residual. The residual is a weighted sum
/// of the differences between 24 neighbours and the pixel, with weights that depend on the pixel's
/// class. Each pixel has two classes, one by gradient and one by curvature, and the mean of their
/// two residuals is used.
namespace mfar::enlarge {

using params::kGrid, params::kPairs, params::kLumaScale, params::kResidualScale;
inline constexpr int kPhases = kGrid * kGrid, kTaps = 2 * kPairs;
/// Number of weights of a filter. They are stored as [pair of taps][phase, row-major][tap of the
/// pair]. A phase is a sub-pixel of the pixel.
inline constexpr int kFilterSize = kTaps * kPhases;
[[nodiscard]] constexpr int filterIndex(int tap, int phase) {
    return (tap / 2 * kPhases + phase) * 2 + tap % 2;
}

struct Offset {
    int x, y;
    bool operator==(const Offset&) const = default;
};
/// Positions of the taps relative to the pixel [px]. The taps come in pairs: taps 2i and 2i + 1 are
/// horizontal neighbours; in the last two pairs, they are vertical neighbours.
inline constexpr std::array<Offset, kTaps> kTapAt{
    {{-2, -2}, {-1, -2}, {0, -2}, {1, -2}, {-2, -1}, {-1, -1}, {0, -1}, {1, -1},
     {-2, 1},  {-1, 1},  {0, 1},  {1, 1},  {-2, 2},  {-1, 2},  {0, 2},  {1, 2},
     {-2, 0},  {-1, 0},  {1, 0},  {2, 0},  {2, -2},  {2, -1},  {2, 1},  {2, 2}}};
[[nodiscard]] constexpr int tapAt(Offset at) {
    for (int i = 0; i < kTaps; ++i)
        if (kTapAt[static_cast<std::size_t>(i)] == at) return i;
    return -1;
}

inline constexpr int kWeightScale = 16384;

/// Classes of pixels by the structure tensor: the mean of the products of gradient components over
/// 5x5 pixels. The class has three values, each divided into bins. Angle: direction of the tensor's
/// main axis. Strength: s1, the square root of the larger eigenvalue [grey levels per px].
/// Coherence: (s1 - s2) / (s1 + s2), where s2 is the square root of the smaller eigenvalue.
/// Class index: (angle bin * number of strength bins + strength bin) * number of coherence bins +
/// coherence bin.
struct GradientClasses {
    static constexpr int kAngles = params::kGradientAngles;
    static constexpr std::array<float, 3> kStrengthFrom{params::kWeakFrom, params::kMediumFrom,
                                                        params::kStrongFrom};
    static constexpr std::array<float, 2> kCoherenceFrom{params::kPartlyCoherentFrom,
                                                         params::kCoherentFrom};
    static constexpr int kKinds = params::kGradientKinds;  ///< classes per angle bin
    static_assert(kKinds == (kStrengthFrom.size() + 1) * (kCoherenceFrom.size() + 1));
    static constexpr int kCount = kAngles * kKinds;
};
/// Classes of pixels by the Hessian, the matrix of second derivatives. The class has three values,
/// each divided into bins: angle of the main axis, Laplacian, and difference of the eigenvalues
/// (both in grey levels per px^2).
/// Class index: (angle bin * number of Laplacian bins + Laplacian bin) * number of difference bins
/// + difference bin.
struct CurvatureClasses {
    static constexpr int kAngles = params::kCurvatureAngles;
    static constexpr std::array<float, 6> kLaplacianFrom{
        -params::kHighLaplacian, -params::kMediumLaplacian, -params::kLowLaplacian,
        params::kLowLaplacian,   params::kMediumLaplacian,  params::kHighLaplacian};
    static constexpr std::array<float, 3> kDifferenceFrom{
        params::kLowDifference, params::kMediumDifference, params::kHighDifference};
    static constexpr int kKinds = params::kCurvatureKinds;
    static_assert(kKinds == (kLaplacianFrom.size() + 1) * (kDifferenceFrom.size() + 1));
    static constexpr int kCount = kAngles * kKinds;
};

/// Maps an angle bin to a bin with stored filters. The bins divide [-pi/2, pi/2) equally. Mirroring
/// the picture, or exchanging x and y, or both, turns every bin into a bin of the quarter
/// [0, pi/4). Therefore, only the filters of this quarter are stored.
struct Symmetry {
    int unique;                ///< bin with the stored filter, counted from angle 0: [0, bins / 4)
    bool mirrors, transposes;  ///< first mirror the picture upside down, then exchange x and y

    [[nodiscard]] static constexpr Symmetry of(int bin, int bins) {
        const bool lower = bin < bins / 2;
        const int inHalf = bin % (bins / 2);
        const bool left = lower == (inHalf < bins / 4);
        const bool ascends = lower == left;
        return {ascends ? inHalf : bins / 2 - 1 - inHalf, lower, left};
    }
    /// Maps a position in a square whose coordinates run from 0 to `last`. With last = 0, `v` is
    /// instead an offset from a pixel, positive or negative.
    [[nodiscard]] constexpr Offset map(Offset v, int last = 0) const {
        const Offset mirrored{v.x, mirrors ? last - v.y : v.y};
        return transposes ? Offset{mirrored.y, mirrored.x} : mirrored;
    }
    [[nodiscard]] constexpr int tap(int i) const {
        return tapAt(map(kTapAt[static_cast<std::size_t>(i)]));
    }
    [[nodiscard]] constexpr int phase(int i) const {
        const Offset at = map({i % kGrid, i / kGrid}, kGrid - 1);
        return at.y * kGrid + at.x;
    }
};
inline constexpr int kUniqueGradient = GradientClasses::kCount / 4;
inline constexpr int kUniqueCurvature = CurvatureClasses::kCount / 4;
inline constexpr int kUnique = kUniqueGradient + kUniqueCurvature;

/// The enlarged value is clamped to the range of the surrounding 5x5 pixels. The range is first
/// extended at both ends by a quarter of its width: the width shifted right by this number of bits.
inline constexpr int kOvershootShift = 2;
static_assert(params::kOvershoot * (1 << kOvershootShift) == 1);

}  // namespace mfar::enlarge
