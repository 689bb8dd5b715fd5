#pragma once

#include <cstdint>

// The classes of tiles and how each is drawn: superres_classify.comp, superres_sharpen.frag,
// superres_vertical.frag, composite_*.frag, tile_rect.vert and their SIMD twins. Shaders read this
// header, too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Values of TileClass.
inline constexpr std::uint32_t kTileUnchanged = 0U;
inline constexpr std::uint32_t kTileUpscaled = 1U;
inline constexpr std::uint32_t kTileTrusted = 2U;
inline constexpr std::uint32_t kTileBlended = 3U;

/// Below this weight the detail changes no pixel by as much as a grey level.
inline constexpr float kLeastDetailWeight = 0.02F;
/// Upper limits of the spread of the flow [video px] and of the weight for tiles that are drawn as
/// one quad; 0.08 px are 0.3 px of the output.
inline constexpr float kPlainFlow = 0.08F;
inline constexpr float kPlainWeight = 0.25F;
/// Excess of the second still's share over the first's above which the second is visible, and above
/// which it alone is. In between it fades in, to avoid a seam.
inline constexpr float kSecondFrom = 0.05F;
inline constexpr float kSecondAlone = 0.15F;
/// Lower limit of the unexplained cells, of 16, of an unexplained tile.
inline constexpr std::uint32_t kUnexplainedCells = 8U;

/// Parameter of Keys' cubic, the kernel of the enlargement.
inline constexpr float kCubicSlope = -0.75F;

/// The first two taps of the inverse of (Keys' cubic averaged over a pixel). The inverse is 1.207,
/// -0.141, 0.044, -0.008, ...; the second tap stands for all further ones, so that the filter keeps
/// its centre and a sum of one.
inline constexpr float kSharpenNear = -0.14123F;
inline constexpr float kSharpenFar = 0.0385F;

/// Width of a video pixel's footprint in the still, relative to the pixel pitch. The footprint has
/// 4x4 samples, spaced a quarter of this width. (1.08 is as good on photographs, but worse for
/// reduced stills.)
inline constexpr float kSeen = 1.0F;

/// A still guides the video's finest detail: the difference of both pictures, minus its mean over
/// the trusted pixels within this reach of a pixel [video px]. The mean contains differences in
/// exposure. A reach of 1 gained 0.08 to 0.1 dB less on synthetic scenes.
inline constexpr int kGuideReach = 2;
/// Margin around a tile in which the still is reduced to the video's resolution; the tile's detail
/// needs less [video px].
inline constexpr int kTileAround = 8;

struct alignas(16) ClassifyTiles {
    std::int32_t columns, rows;  ///< of tiles
    std::int32_t cellColumns, cellRows;
    float leastWeight;          ///< kLeastDetailWeight, or -1: no tile is only upscaled
    float plainFlow;            ///< kPlainFlow, or 0: plain tiles do not occur [video px]
    std::int32_t stillGiven;    ///< 0: there is no still, the fields are blank
    std::uint32_t detailFrame;  ///< unique per frame; 0: no tile depends on its neighbours
    std::int32_t learns;        ///< 1: matched tiles are enlarged by learned filters
    std::int32_t secondGiven;   ///< 0: there is no second still, its fields are blank
};

/// For all programs that draw tiles.
struct alignas(16) DrawTiles {
    std::int32_t videoWidth, videoHeight;  ///< [px]
    std::int32_t cellColumns, cellRows;
    float scaleX, scaleY;                ///< video pixels per output pixel
    float stillTexelX, stillTexelY;      ///< 1 / size of the still [1/px]
    float stillScaleX, stillScaleY;      ///< still pixels per output pixel
    float sharpening;                    ///< strength; 0: none
    float guidanceStill, guidanceVideo;  ///< FilterBank::guidance()
};

}  // namespace mfar::params
