#pragma once

namespace mfar {

/// What the 2-D flow trades time against error by. The defaults are what measured best on
/// llvmpipe. Cells of 4x4 pixels, patches of 8x8 and workgroups are laid out in the shaders.
struct Flow2dOptions {
    int levels = 6;         ///< of the pyramid, at most those that are there; [1, 6]
    int searchRadius = 10;  ///< at the coarsest level, without the last frame's field [px]; [0, 40]
    int candidates = 4;     ///< vectors of the coarser level each cell tries; [1, 4]
    int steps = 4;          ///< of Gauss-Newton after the best candidate; [0, 16]
    int propagations = 0;   ///< rounds at the finest level, video to still; [0, 8]
    int coarsestPropagations = 4;  ///< rounds at the coarsest level; [0, 8]
    int planeFits = 2;             ///< rounds of the clean-up after its median; [0, 2]

    bool operator==(const Flow2dOptions&) const = default;
};

/// The same of the epipolar search. Its windows of 16 labels and its four paths are laid out in
/// vectors of bytes.
struct EpipolarOptions {
    int levels = 4;                ///< at most; one has 60 px at least on its short side; [1, 4]
    double longestParallax = 0.8;  ///< longest way sought, as a share of the width; (0, 1]
    int windowRadius = 2;  ///< of the coarser level's labels that a window covers [px]; [0, 8]
    int stepPenalty = 12;  ///< Smoothness::step without noise; [1, 30]
    int jumpPenalty = 60;  ///< Smoothness::jump; [1, 60]
    int finest = 0;  ///< level the search ends at: 1, 2: a half, a quarter of the pixels; [0, 2]
    /// Of EpipolarFlow: frames in a row searched around what the one before showed; [0, 60].
    int mostPredicted = 7;

    bool operator==(const EpipolarOptions&) const = default;
};

/// `now` with what of `wanted` may change between frames: all but what memory is laid out for
/// (levels, longestParallax).
[[nodiscard]] Flow2dOptions changed(const Flow2dOptions& now, const Flow2dOptions& wanted);
[[nodiscard]] EpipolarOptions changed(const EpipolarOptions& now, const EpipolarOptions& wanted);

/// Throw std::invalid_argument that names the first option out of its range.
void validate(const Flow2dOptions& options);
void validate(const EpipolarOptions& options);

/// The options, when they are valid: for initialisers.
template <class Options>
[[nodiscard]] Options validated(const Options& options) {
    validate(options);
    return options;
}

}  // namespace mfar
