#pragma once

#include <cstdint>

// Parameters for classifying and drawing tiles, in the shaders superres_classify.comp,
// superres_sharpen.frag, superres_vertical.frag, composite_*.frag and tile_rect.vert and in the
// SIMD code. params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

inline constexpr std::uint32_t kTileUnchanged = 0U;
inline constexpr std::uint32_t kTileUpscaled = 1U;
inline constexpr std::uint32_t kTileTrusted = 2U;
inline constexpr std::uint32_t kTileBlended = 3U;

/// If the still's detail has less weight than this, it changes each pixel by less than a grey
/// level.
inline constexpr float kLeastDetailWeight = 0.02F;
/// A tile is drawn as one rectangle if its flow deviates from an affine function of the position by
/// less than kPlainFlow [video px] and its weight varies by less than kPlainWeight. 0.08 video px
/// are about 0.3 px of the output.
inline constexpr float kPlainFlow = 0.08F;
inline constexpr float kPlainWeight = 0.25F;
/// The opacity of the second still depends on its weight minus the first still's weight. It is 0 up
/// to a difference of kSecondFrom, and 1 from kSecondAlone on.
inline constexpr float kSecondFrom = 0.05F;
inline constexpr float kSecondAlone = 0.15F;
/// A tile counts as not matching the still if at least this number of its 16 cells has no reliable
/// match.
inline constexpr std::uint32_t kUnexplainedCells = 8U;

/// Parameter a of Keys' cubic, the kernel that enlarges the video.
inline constexpr float kCubicSlope = -0.75F;

/// Taps of the sharpening filter at distances of one and two pixels. The filter inverts the blur by
/// Keys' cubic and by the area of a sensor pixel. The exact inverse has the taps 1.207, -0.141,
/// 0.044, -0.008, ... at distances of 0, 1, 2, 3, ... pixels. kSharpenFar replaces all taps from
/// 0.044 on. It is chosen so that the centre tap is exact and the sum of all taps is one.
inline constexpr float kSharpenNear = -0.14123F;
inline constexpr float kSharpenFar = 0.0385F;

/// Width of the area over which the still is averaged for a video pixel [video px], with 4x4
/// samples. (A width of 1.08 is as good on photographs, but worse for reduced stills.)
inline constexpr float kSeen = 1.0F;

/// The guidance is the weighted difference of still and video, minus the local mean of this
/// difference. The mean is subtracted, because it contains the difference in exposure. It is
/// computed over the trusted pixels within kGuideReach pixels along each axis [video px]. A
/// distance of 1 gained 0.08 to 0.1 dB less on synthetic scenes.
inline constexpr int kGuideReach = 2;
/// The still is reduced to the video's resolution in a tile and in this margin around it [video
/// px]. Drawing the tile's detail reads only a part of the margin.
inline constexpr int kTileAround = 8;

struct alignas(16) ClassifyTiles {
    std::int32_t columns, rows;
    std::int32_t cellColumns, cellRows;
    /// kLeastDetailWeight, or -1 if matched tiles shall not get the class Upscaled.
    float leastWeight;
    /// kPlainFlow [video px], or 0 if no tile shall be drawn as one rectangle.
    float plainFlow;
    std::int32_t stillGiven;
    /// Number of the frame. The shader stores it for each unchanged tile that it lists because a
    /// neighbour is drawn, so that no tile is listed twice. 0: these tiles are not listed, because
    /// drawing a tile's detail does not read its neighbours.
    std::uint32_t detailFrame;
    std::int32_t learns;
    std::int32_t secondGiven;
};

struct alignas(16) DrawTiles {
    std::int32_t videoWidth, videoHeight;
    std::int32_t cellColumns, cellRows;
    float scaleX, scaleY;            ///< video pixels per output pixel
    float stillTexelX, stillTexelY;  ///< 1 / size of the still [1/px]
    float stillScaleX, stillScaleY;  ///< still pixels per output pixel
    float sharpening;
    float guidanceStill, guidanceVideo;  ///< see FilterBank::guidance()
};

}  // namespace mfar::params
