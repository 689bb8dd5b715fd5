#pragma once

#include <cstdint>

// Parameters for classifying and drawing tiles, in the shader superres_classify.comp, in all
// shaders that include tile_params.glsl, and in the SIMD code. params_to_glsl.cmake translates this
// header to GLSL.
namespace mfar::params {

inline constexpr std::uint32_t kTileUnchanged = 0U;
inline constexpr std::uint32_t kTileEnlarged = 1U;
inline constexpr std::uint32_t kTileTrusted = 2U;
inline constexpr std::uint32_t kTileBlended = 3U;

/// A tile whose weights are all at most this is drawn without the still's detail. (With this
/// weight, a detail of 50 grey levels would change a pixel by one grey level.)
inline constexpr float kLeastDetailWeight = 0.02F;
/// A tile is drawn as one rectangle if two conditions hold: its flow deviates from an affine
/// function of the position by less than kPlainFlow [video px], and its weight varies by less than
/// kPlainWeight. If the output has 3.6 pixels per video pixel, a deviation of 0.08 video px is
/// about 0.3 px of the output.
inline constexpr float kPlainFlow = 0.08F;
inline constexpr float kPlainWeight = 0.25F;
/// Where two stills are used, the second is drawn over the first. Its opacity depends on the weight
/// of the second still minus the weight of the first: 0 up to a difference of kSecondFrom, and 1
/// from kSecondAlone on.
inline constexpr float kSecondFrom = 0.05F;
inline constexpr float kSecondAlone = 0.15F;
/// A tile counts as not matching the still if at least this number of its 16 cells has no reliable
/// match.
inline constexpr std::uint32_t kUnexplainedCells = 8U;

/// Parameter a of Keys' cubic, the kernel that enlarges the video.
inline constexpr float kCubicSlope = -0.75F;

/// Taps of the sharpening filter at distances of one and two pixels. The filter approximately
/// inverts the blur that Keys' cubic and the area of a sensor pixel cause together. In one
/// dimension, the exact inverse has the taps 1.207, -0.141, 0.044, -0.008, ... at distances of 0,
/// 1, 2, 3, ... pixels. kSharpenNear is the exact tap. kSharpenFar replaces all taps from distance
/// 2 on (of one side); it is a little larger than their sum, 0.0375. The centre tap is one minus
/// the other taps: 1.205.
inline constexpr float kSharpenNear = -0.14123F;
inline constexpr float kSharpenFar = 0.0385F;

/// A video pixel sees a square of this width of the still [video px]. The still is averaged over
/// the square with 4x4 samples. (A width of 1.08 is as good on photographs, but worse for reduced
/// stills.)
///
/// A sensor averages light, and its grey levels are roughly the square root of light. So where the
/// still's grey levels in the square differ, the video is brighter than their mean m: it shows
/// about r, the root of the mean of their squares. But if the video was reduced from a larger
/// picture, it shows m. The mean used is m + light * (r - m), with the learned factor
/// Guidance::light. With a factor of 1, printed text and leaves gain 0.2 to 0.5 dB on synthetic
/// scenes.
inline constexpr float kSeen = 1.0F;

/// Guidance replaces a part of the video's finest detail by the still's. It adds the weighted
/// difference of still and video, minus the local mean of this difference. The mean is subtracted
/// because it contains the difference in exposure. The mean is over the trusted pixels that are at
/// most kGuideReach video pixels away along each axis. (With 1 instead of 2, guidance gained
/// 0.08 to 0.1 dB less on synthetic scenes.)
inline constexpr int kGuideReach = 2;
/// For each tile that shows the second still, the GLES engine reduces this still to the video's
/// resolution in the tile and in a margin of this width around it [video px]. Drawing reads only a
/// part of the margin.
inline constexpr int kTileAround = 8;

struct alignas(16) ClassifyTiles {
    std::int32_t columns, rows;
    std::int32_t cellColumns, cellRows;
    /// Largest weight of the still in a tile of the class kTileEnlarged: kLeastDetailWeight, or -1
    /// so that no matched tile gets this class.
    float leastWeight;
    /// A tile is drawn as one rectangle only if its flow deviates from an affine function by less
    /// than this [video px]. It is kPlainFlow, or 0 to draw no tile in this way.
    float plainFlow;
    std::int32_t stillGiven;
    /// Number of the frame. Drawing a tile's detail reads the neighbouring tiles, so unchanged
    /// neighbours are listed, too. The shader stores this number for each of them, so that none is
    /// listed twice. 0: neighbours are not listed, because no drawn tile reads them.
    std::uint32_t detailFrame;
    std::int32_t learns;  ///< 1: learned filters enlarge the matched tiles
    std::int32_t secondGiven;
};

struct alignas(16) DrawTiles {
    std::int32_t videoWidth, videoHeight;
    std::int32_t cellColumns, cellRows;
    float scaleX, scaleY;            ///< video pixels per output pixel
    float stillTexelX, stillTexelY;  ///< 1 / size of the still [1/px]
    float stillScaleX, stillScaleY;  ///< still pixels per output pixel
    float sharpening;
    float guidanceStill, guidanceVideo, guidanceLight;  ///< see FilterBank::guidance()
};

}  // namespace mfar::params
