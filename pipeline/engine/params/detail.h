#pragma once

#include <cstdint>

// Parameters for classifying and drawing tiles, used by superres_classify.comp,
// superres_sharpen.frag, superres_vertical.frag, composite_*.frag, tile_rect.vert and the SIMD code
// of the same steps. gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

/// The values of the enumeration TileClass, as numbers.
inline constexpr std::uint32_t kTileUnchanged = 0U;
inline constexpr std::uint32_t kTileUpscaled = 1U;
inline constexpr std::uint32_t kTileTrusted = 2U;
inline constexpr std::uint32_t kTileBlended = 3U;

/// If the still's detail has less than this weight, it changes no pixel by a grey level or more.
inline constexpr float kLeastDetailWeight = 0.02F;
/// A tile is drawn as one quad if its flow deviates from an affine function by less than kPlainFlow
/// [video px] and its weight varies by less than kPlainWeight. 0.08 video px are 0.3 px of the
/// output.
inline constexpr float kPlainFlow = 0.08F;
inline constexpr float kPlainWeight = 0.25F;
/// The second still is visible where its weight exceeds the first still's weight by more than
/// kSecondFrom. If it exceeds it by kSecondAlone or more, only the second still is visible. In
/// between it fades in, to avoid a seam.
inline constexpr float kSecondFrom = 0.05F;
inline constexpr float kSecondAlone = 0.15F;
/// A tile is unexplained if at least this number of its 16 cells is unexplained.
inline constexpr std::uint32_t kUnexplainedCells = 8U;

/// Parameter a of Keys' cubic, the kernel that enlarges the video.
inline constexpr float kCubicSlope = -0.75F;

/// Taps of the sharpening filter at distances of one and two pixels from its centre. The filter
/// inverts the blur by Keys' cubic and by the area of a sensor pixel. The exact inverse is 1.207,
/// -0.141, 0.044, -0.008, ...; here, the tap at two pixels also replaces all farther ones, so that
/// the centre tap and the sum of the filter, one, stay the same.
inline constexpr float kSharpenNear = -0.14123F;
inline constexpr float kSharpenFar = 0.0385F;

/// Width of the area over which the still is averaged for a video pixel [video px]. The area is
/// sampled at 4x4 positions, spaced by a quarter of this width. (A width of 1.08 is as good on
/// photographs, but worse for reduced stills.)
inline constexpr float kSeen = 1.0F;

/// The guidance signal is a weighted difference of still and video; it corrects the video's finest
/// detail. The local mean of this difference is subtracted first, because it contains the
/// difference in exposure. The mean is computed over the trusted pixels within this distance of a
/// pixel along each axis [video px]. A distance of 1 gained 0.08 to 0.1 dB less on synthetic
/// scenes.
inline constexpr int kGuideReach = 2;
/// Margin around a tile [video px] in which the still is reduced to the video's resolution, too.
/// Drawing the detail of the tile needs less than this margin.
inline constexpr int kTileAround = 8;

struct alignas(16) ClassifyTiles {
    std::int32_t columns, rows;  ///< number of tiles
    std::int32_t cellColumns, cellRows;
    float leastWeight;          ///< kLeastDetailWeight; -1: no tile gets the class "upscaled"
    float plainFlow;            ///< kPlainFlow [video px]; 0: no tile is plain
    std::int32_t stillGiven;    ///< 1: there is a still; 0: there is none, and its fields are empty
    std::uint32_t detailFrame;  ///< number of the frame; 0: no tile depends on its neighbours
    std::int32_t learns;        ///< 1: matched tiles are enlarged by learned filters
    std::int32_t secondGiven;   ///< 1: there is a second still; 0: there is none, and its fields
                                ///< are empty
};

/// Parameters of all shaders that draw tiles.
struct alignas(16) DrawTiles {
    std::int32_t videoWidth, videoHeight;  ///< [px]
    std::int32_t cellColumns, cellRows;
    float scaleX, scaleY;                ///< video pixels per output pixel
    float stillTexelX, stillTexelY;      ///< 1 / size of the still [1/px]
    float stillScaleX, stillScaleY;      ///< still pixels per output pixel
    float sharpening;                    ///< strength of the sharpening; 0: none
    float guidanceStill, guidanceVideo;  ///< FilterBank::guidance()
};

}  // namespace mfar::params
