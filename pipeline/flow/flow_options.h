#pragma once

namespace mfar {

/// Options of the 2-D flow that trade run time for accuracy. The defaults were the best in
/// measurements on llvmpipe. The sizes of cells, patches (8x8 pixels) and workgroups are fixed in
/// the shaders.
struct Flow2dOptions {
    int levels = 6;  ///< largest number of pyramid levels, [1, 6]
    /// Search radius at the coarsest pyramid level if no earlier flow is known [px], [0, 40].
    int searchRadius = 10;
    /// Number of vectors of the next coarser pyramid level that each cell evaluates, [1, 4].
    int candidates = 4;
    int steps = 4;  ///< number of Gauss-Newton steps from the best candidate, [0, 16]
    /// Number of rounds in which cells adopt vectors of their neighbours, [0, 8]. `propagations`:
    /// at the finest pyramid level, from video to still. `coarsestPropagations`: at the coarsest
    /// pyramid level.
    int propagations = 0;
    int coarsestPropagations = 4;
    int planeFits = 2;  ///< number of rounds of plane fits (flow_filter.comp), [0, 2]

    bool operator==(const Flow2dOptions&) const = default;
};

/// Options of the epipolar search. The number of candidates (labels) per pixel is fixed to 16,
/// because their costs are processed as vectors of 16 bytes. The cost aggregation always has four
/// directions.
struct EpipolarOptions {
    int levels = 4;  ///< Largest number of pyramid levels, [1, 4]. All have at least 60x60 px.
    /// Largest searched parallax, as a share of the picture's width, (0, 1].
    double longestParallax = 0.8;
    /// Radius of a pixel's neighbourhood at the coarser pyramid level [px], [0, 8]. At the finer
    /// level, a pixel's candidates of s lie around the range that was found in this neighbourhood.
    int windowRadius = 2;
    int stepPenalty = 12;  ///< Smoothness::step for a picture without noise, [1, 30]
    int jumpPenalty = 60;  ///< see Smoothness::jump, [1, 60]
    /// Finest searched pyramid level (0 is full size, 1 half, 2 a quarter), [0, 2].
    int finest = 0;
    /// Largest number of consecutive frames that EpipolarFlow searches only around a prediction
    /// from the last frame, [0, 60].
    int mostPredicted = 7;

    bool operator==(const EpipolarOptions&) const = default;
};

/// Both functions return `wanted`, but with levels and longestParallax of `now`: these options
/// determine the memory layout, so they cannot change between frames.
[[nodiscard]] Flow2dOptions changed(const Flow2dOptions& now, const Flow2dOptions& wanted);
[[nodiscard]] EpipolarOptions changed(const EpipolarOptions& now, const EpipolarOptions& wanted);

/// Both functions throw std::invalid_argument that names the first option that is out of range.
void validate(const Flow2dOptions& options);
void validate(const EpipolarOptions& options);

/// Returns valid options unchanged, otherwise throws like validate(). For use in initialisers.
template <class Options>
[[nodiscard]] Options validated(const Options& options) {
    validate(options);
    return options;
}

}  // namespace mfar
