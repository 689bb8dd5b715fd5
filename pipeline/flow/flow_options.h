#pragma once

namespace mfar {

/// Options of the 2-D flow that trade run time against error. The defaults were the best in
/// measurements on llvmpipe. Cells of 4x4 pixels, patches of 8x8 pixels and the workgroup sizes are
/// fixed in the shaders.
struct Flow2dOptions {
    int levels = 6;         ///< upper limit of the number of pyramid levels; [1, 6]
    int searchRadius = 10;  ///< at the coarsest level, if no last flow is known [px]; [0, 40]
    int candidates = 4;     ///< vectors of the coarser level that each cell tries; [1, 4]
    int steps = 4;          ///< Gauss-Newton steps from the best candidate; [0, 16]
    int propagations = 0;   ///< rounds at the finest level, from video to still; [0, 8]
    int coarsestPropagations = 4;  ///< rounds at the coarsest level; [0, 8]
    int planeFits = 2;             ///< plane fits after the median filter of the clean-up; [0, 2]

    bool operator==(const Flow2dOptions&) const = default;
};

/// Options of the epipolar search. Windows of 16 labels and four paths are fixed, because labels
/// are stored in byte vectors.
struct EpipolarOptions {
    int levels = 4;                ///< most pyramid levels; short sides are at least 60 px; [1, 4]
    double longestParallax = 0.8;  ///< upper limit of the parallax, relative to the width; (0, 1]
    int windowRadius = 2;          ///< radius in which a window covers coarser labels [px]; [0, 8]
    int stepPenalty = 12;          ///< Smoothness::step without noise; [1, 30]
    int jumpPenalty = 60;          ///< Smoothness::jump; [1, 60]
    int finest = 0;  ///< last level that is searched; 1: half size, 2: quarter size; [0, 2]
    /// For EpipolarFlow: number of consecutive frames that are searched only around a prediction
    /// from the last frame; [0, 60].
    int mostPredicted = 7;

    bool operator==(const EpipolarOptions&) const = default;
};

/// Returns `now` with those members of `wanted` that may change between frames. These are all
/// members except those that determine the memory layout (levels, longestParallax).
[[nodiscard]] Flow2dOptions changed(const Flow2dOptions& now, const Flow2dOptions& wanted);
[[nodiscard]] EpipolarOptions changed(const EpipolarOptions& now, const EpipolarOptions& wanted);

/// These throw std::invalid_argument whose message names the first option that is out of range.
void validate(const Flow2dOptions& options);
void validate(const EpipolarOptions& options);

/// Returns the options if they are valid, otherwise throws; for use in initialisers.
template <class Options>
[[nodiscard]] Options validated(const Options& options) {
    validate(options);
    return options;
}

}  // namespace mfar
