#pragma once

namespace mfar {

/// Options that trade run time against error in the 2-D flow. The defaults measured best on
/// llvmpipe. The shaders fix cells of 4x4 pixels, patches of 8x8 and workgroups.
struct Flow2dOptions {
    int levels = 6;         ///< upper limit of the pyramid's levels in use; [1, 6]
    int searchRadius = 10;  ///< at the coarsest level, without the last frame's field [px]; [0, 40]
    int candidates = 4;     ///< vectors of the coarser level that each cell tries; [1, 4]
    int steps = 4;          ///< Gauss-Newton steps after the best candidate; [0, 16]
    int propagations = 0;   ///< rounds at the finest level, video to still; [0, 8]
    int coarsestPropagations = 4;  ///< rounds at the coarsest level; [0, 8]
    int planeFits = 2;             ///< rounds of the clean-up after its median filter; [0, 2]

    bool operator==(const Flow2dOptions&) const = default;
};

/// Options of the epipolar search. Its layout in vectors of bytes fixes windows of 16 labels and
/// four paths.
struct EpipolarOptions {
    int levels = 4;                ///< upper limit; short sides are at least 60 px; [1, 4]
    double longestParallax = 0.8;  ///< upper limit of the parallax, as a share of the width; (0, 1]
    int windowRadius = 2;          ///< coarser labels that a window covers, radius [px]; [0, 8]
    int stepPenalty = 12;          ///< Smoothness::step without noise; [1, 30]
    int jumpPenalty = 60;          ///< Smoothness::jump; [1, 60]
    int finest = 0;  ///< last level of the search; 1: half size, 2: quarter size; [0, 2]
    /// For EpipolarFlow: consecutive frames searched around the prediction from the last; [0, 60].
    int mostPredicted = 7;

    bool operator==(const EpipolarOptions&) const = default;
};

/// `now` with the members of `wanted` that may change between frames: all except those that
/// determine the memory layout (levels, longestParallax).
[[nodiscard]] Flow2dOptions changed(const Flow2dOptions& now, const Flow2dOptions& wanted);
[[nodiscard]] EpipolarOptions changed(const EpipolarOptions& now, const EpipolarOptions& wanted);

/// Throw std::invalid_argument that names the first option out of its range.
void validate(const Flow2dOptions& options);
void validate(const EpipolarOptions& options);

/// Returns the options if they are valid, else throws; for initialisers.
template <class Options>
[[nodiscard]] Options validated(const Options& options) {
    validate(options);
    return options;
}

}  // namespace mfar
