#pragma once

namespace mfar {

/// Options of the 2-D flow. They trade run time for accuracy. The defaults were the best in
/// measurements on llvmpipe. The sizes of cells, patches (8x8 pixels) and workgroups are not
/// options, because they are fixed in the shaders.
struct Flow2dOptions {
    int levels = 6;  ///< largest number of pyramid levels, [1, 6]
    /// Search radius at the coarsest pyramid level if no earlier flow is known [px], [0, 40].
    int searchRadius = 10;
    /// Each cell tries this number of flow vectors from the next coarser pyramid level, [1, 4].
    int candidates = 4;
    int steps = 4;  ///< number of Gauss-Newton steps from the best candidate, [0, 16]
    /// Number of rounds in which each cell tries the flow vectors of its neighbours, [0, 8].
    /// `propagations`: at the finest pyramid level of the flow from video to still.
    /// `coarsestPropagations`: at the coarsest level. Other levels have fixed numbers of rounds.
    int propagations = 0;
    int coarsestPropagations = 4;
    int planeFits = 2;  ///< number of rounds of plane fits (flow_filter.comp), [0, 2]

    bool operator==(const Flow2dOptions&) const = default;
};

/// Options of the epipolar search. Two properties are fixed. First, the number of candidates
/// (labels) per pixel is 16, and at the coarsest pyramid level a multiple of 16, because costs are
/// processed as vectors of 16 bytes. Second, costs are aggregated from four directions.
struct EpipolarOptions {
    /// Largest number of pyramid levels, [1, 4]. Levels below full size have at least 60x60 px.
    int levels = 4;
    /// Largest searched parallax, as a share of the picture's width, (0, 1].
    double longestParallax = 0.8;
    /// The labels that are searched at a pixel are centred on the range of labels that the next
    /// coarser pyramid level found within this distance of the pixel [px of the coarser level],
    /// [0, 8]. If that range is wide, only a part of it is searched.
    int windowRadius = 2;
    int stepPenalty = 12;  ///< Smoothness::step for a picture without noise, [1, 30]
    int jumpPenalty = 60;  ///< see Smoothness::jump, [1, 60]
    /// Finest searched pyramid level (0 is full size, 1 half, 2 a quarter), [0, 2].
    int finest = 0;
    /// The epipolar search of a frame can be restricted to values of s predicted from the last
    /// frame. After this number of successive frames with such a search, the next frame is searched
    /// completely. The option's range is [0, 60].
    int mostPredicted = 7;

    bool operator==(const EpipolarOptions&) const = default;
};

/// These functions return `wanted`, but with `levels` and EpipolarOptions::longestParallax of
/// `now`. These two options determine the memory layout, so they cannot change between frames. If
/// `wanted` is invalid, the functions throw like validate().
[[nodiscard]] Flow2dOptions changed(const Flow2dOptions& now, const Flow2dOptions& wanted);
[[nodiscard]] EpipolarOptions changed(const EpipolarOptions& now, const EpipolarOptions& wanted);

/// These functions throw std::invalid_argument if an option is out of range. The message names the
/// first such option.
void validate(const Flow2dOptions& options);
void validate(const EpipolarOptions& options);

/// Returns `options` unchanged if they are valid. Otherwise, throws like validate(). For use in
/// initialisers.
template <class Options>
[[nodiscard]] Options validated(const Options& options) {
    validate(options);
    return options;
}

}  // namespace mfar
