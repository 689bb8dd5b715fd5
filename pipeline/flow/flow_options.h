#pragma once

namespace mfar {

/// Options of the 2-D flow that trade run time against error. The defaults were the best in
/// measurements on llvmpipe. The sizes of cells (4x4 pixels), patches (8x8 pixels) and workgroups
/// are fixed in the shaders.
struct Flow2dOptions {
    int levels = 6;         ///< largest number of pyramid levels; [1, 6]
    int searchRadius = 10;  ///< search radius at the coarsest pyramid level [px], if the last
                            ///< frame's flow is not known; [0, 40]
    int candidates = 4;     ///< number of vectors of the next coarser pyramid level that are
                            ///< evaluated at each cell; [1, 4]
    int steps = 4;          ///< number of Gauss-Newton steps from the best candidate; [0, 16]
    int propagations = 0;   ///< number of rounds in which cells take over vectors of their
                            ///< neighbours, at the finest pyramid level, from video to still; [0,
                            ///< 8]
    int coarsestPropagations = 4;  ///< number of rounds in which cells take over vectors of their
                                   ///< neighbours, at the coarsest pyramid level; [0, 8]
    int planeFits = 2;             ///< number of rounds of plane fits (flow_filter.comp) after the
                                   ///< median filter; [0, 2]

    bool operator==(const Flow2dOptions&) const = default;
};

/// Options of the epipolar search. Fixed are the number of candidates (labels) per pixel, 16,
/// because their costs are processed as vectors of 16 bytes, and the four directions of the cost
/// aggregation.
struct EpipolarOptions {
    int levels = 4;                ///< largest number of pyramid levels; each is at least 60 px
                                   ///< high and wide; [1, 4]
    double longestParallax = 0.8;  ///< largest parallax that is searched, as a fraction of the
                                   ///< picture's width; (0, 1]
    int windowRadius = 2;          ///< a pixel's candidates of s cover the results that the coarser
                                   ///< pyramid level has within this radius of it [px]; [0, 8]
    int stepPenalty = 12;          ///< Smoothness::step for a picture without noise; [1, 30]
    int jumpPenalty = 60;          ///< Smoothness::jump; [1, 60]
    int finest = 0;  ///< finest pyramid level that is searched; 0: full size, 1: half size, 2:
                     ///< quarter size; [0, 2]
    /// For EpipolarFlow: largest number of consecutive frames that are searched only around a
    /// prediction from the last frame; [0, 60].
    int mostPredicted = 7;

    bool operator==(const EpipolarOptions&) const = default;
};

/// Returns `now` with those members of `wanted` that may change between frames. These are all
/// members except those that determine the memory layout (levels, longestParallax).
[[nodiscard]] Flow2dOptions changed(const Flow2dOptions& now, const Flow2dOptions& wanted);
[[nodiscard]] EpipolarOptions changed(const EpipolarOptions& now, const EpipolarOptions& wanted);

/// Throw std::invalid_argument if an option is out of range. The message names the first such
/// option.
void validate(const Flow2dOptions& options);
void validate(const EpipolarOptions& options);

/// Returns the options if they are valid. Otherwise throws like validate(). For use in
/// initialisers.
template <class Options>
[[nodiscard]] Options validated(const Options& options) {
    validate(options);
    return options;
}

}  // namespace mfar
