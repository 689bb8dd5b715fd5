#pragma once

#include <cstdint>

// The classes of tiles, and how each class is drawn: superres_classify.comp, superres_sharpen.frag,
// superres_vertical.frag, composite_*.frag, tile_rect.vert and the SIMD code of the same steps.
// gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

/// Values of TileClass.
inline constexpr std::uint32_t kTileUnchanged = 0U;
inline constexpr std::uint32_t kTileUpscaled = 1U;
inline constexpr std::uint32_t kTileTrusted = 2U;
inline constexpr std::uint32_t kTileBlended = 3U;

/// Below this weight, the detail changes every pixel by less than a grey level.
inline constexpr float kLeastDetailWeight = 0.02F;
/// A tile is drawn as one quad if its flow varies by less than kPlainFlow [video px] and its weight
/// by less than kPlainWeight. 0.08 video px are 0.3 px of the output.
inline constexpr float kPlainFlow = 0.08F;
inline constexpr float kPlainWeight = 0.25F;
/// The second still is visible where its weight exceeds the first still's by more than kSecondFrom.
/// From kSecondAlone on, only the second still is visible. In between it fades in, to avoid a seam.
inline constexpr float kSecondFrom = 0.05F;
inline constexpr float kSecondAlone = 0.15F;
/// A tile is unexplained if at least this number of its 16 cells is unexplained.
inline constexpr std::uint32_t kUnexplainedCells = 8U;

/// Parameter a of Keys' cubic, the kernel of the enlargement.
inline constexpr float kCubicSlope = -0.75F;

/// The first two taps beside the centre of the filter that inverts (Keys' cubic averaged over a
/// pixel). The exact inverse is 1.207, -0.141, 0.044, -0.008, ...; the second tap also replaces all
/// further ones, so that the filter keeps its centre and a sum of one.
inline constexpr float kSharpenNear = -0.14123F;
inline constexpr float kSharpenFar = 0.0385F;

/// Width of a video pixel's footprint in the still, relative to the pixel pitch. The footprint is
/// sampled at 4x4 places, spaced by a quarter of this width. (A width of 1.08 is as good on
/// photographs, but worse for reduced stills.)
inline constexpr float kSeen = 1.0F;

/// Guidance corrects the video's finest detail by the difference of still and video. The mean of
/// this difference is subtracted first, because it contains the difference in exposure. The mean is
/// taken over the trusted pixels within this distance of a pixel [video px]. A distance of 1 gained
/// 0.08 to 0.1 dB less on synthetic scenes.
inline constexpr int kGuideReach = 2;
/// Margin around a tile [video px] in which the still is reduced to the video's resolution. The
/// detail of the tile needs less than this margin.
inline constexpr int kTileAround = 8;

struct alignas(16) ClassifyTiles {
    std::int32_t columns, rows;  ///< of tiles
    std::int32_t cellColumns, cellRows;
    float leastWeight;          ///< kLeastDetailWeight, or -1: no tile is only upscaled
    float plainFlow;            ///< kPlainFlow [video px], or 0: no tile is plain
    std::int32_t stillGiven;    ///< 0: there is no still, its fields are empty
    std::uint32_t detailFrame;  ///< unique per frame; 0: no tile depends on its neighbours
    std::int32_t learns;        ///< 1: matched tiles are enlarged by learned filters
    std::int32_t secondGiven;   ///< 0: there is no second still, its fields are empty
};

/// Parameters of all programs that draw tiles.
struct alignas(16) DrawTiles {
    std::int32_t videoWidth, videoHeight;  ///< [px]
    std::int32_t cellColumns, cellRows;
    float scaleX, scaleY;                ///< video pixels per output pixel
    float stillTexelX, stillTexelY;      ///< 1 / size of the still [1/px]
    float stillScaleX, stillScaleY;      ///< still pixels per output pixel
    float sharpening;                    ///< strength; 0: no sharpening
    float guidanceStill, guidanceVideo;  ///< FilterBank::guidance()
};

}  // namespace mfar::params
