#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// The 2-D flow: flow_*.comp and their SIMD twins; what is no option. Shaders read this header, too:
// gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// With the last frame's field among the candidates only what moved on its own needs a search.
inline constexpr int kTrackingRadius = 3;
/// Of tiles off their epipolar lines: 5 px are 80 px of the frame; what moved farther since the
/// still is not worth four times the search.
inline constexpr int kListedRadius = 5;
/// Gauss-Newton steps after a neighbour's vector fitted better.
inline constexpr int kPropagateSteps = 2;
/// From a vector that is right but for a fraction of a pixel; four gain nothing.
inline constexpr int kAlignSteps = 2;
/// The backward field only confirms: a tenth of a coarser level's pixel is a tenth of eq. 2's
/// alpha.
inline constexpr int kBackwardFinest = 1;
inline constexpr int kBackwardPropagations = 1;

/// Energy of an 8x8 patch [grey levels^2] from which on its cost says something: eight times that
/// of a grey level of noise.
inline constexpr float kTexturePerVariance = 8.0F * kPatchPixels;
inline constexpr float kUnexplainedCost = 0.4F;
/// Two-way error [px] of cells that the still cannot show. What lies behind something else is
/// searched: what moves hides and is hidden, and the z-test believes the lines.
inline constexpr float kNotShown = 100.0F;
/// Unexplained cells of a tile that is searched, of 16.
inline constexpr int kLeastUnexplained = 3;

/// The z-test says nothing about what moves by itself: its cells are trusted by their cost, from
/// wholly to not at all (error = alpha of eq. 2).
inline constexpr float kGoodCost = 0.1F;
inline constexpr float kErrorPerCost = 5.0F;
/// Of a vector to that of its epipolar line [px].
inline constexpr float kOnLine = 1.0F;
/// A cell leaves its line only for a cost this much lower: among many vectors one fits noise by
/// chance.
inline constexpr float kClearlyLess = 0.5F;

/// Change of the flow [px per px]; more of it is a depth edge rather than a surface.
inline constexpr float kSteepestFlow = 0.25F;

/// Cells on each side of the one that a plane is fitted at.
inline constexpr int kCleanUpRadius = 2;
/// Neighbours that differ by more [px] from the plane lie on another surface; the first round knows
/// no slope yet and has to let it pass.
inline constexpr float kFirstPlaneReach = 1.2F;
inline constexpr float kPlaneReach = 0.5F;
/// Energy of texture in a patch at which half of the trust is reached [grey levels^2].
inline constexpr float kHalfTrusted = 2000.0F;
/// Weight of a cell that nothing is known about but its value.
inline constexpr float kLeastPlaneWeight = 1e-4F;
/// Added to the slopes' diagonal, at no weight and for each cell's: a lone neighbour makes no
/// plane.
inline constexpr float kSlopeDamping = 0.5F;
inline constexpr float kSlopeDampingPerWeight = 0.05F;

/// Fields are areas of patches[], named by their first cell.
struct alignas(16) SearchFlow {
    LumaLevel from, to;  ///< where the patches are taken, where they are sought
    std::int32_t columns, rows;
    std::int32_t coarserColumns, coarserRows;
    std::int32_t target;
    std::int32_t coarser;    ///< field of the coarser level; -1: this is the coarsest
    std::int32_t lastFrame;  ///< field of the last frame; -1: none
    std::int32_t lastFrameColumns;
    std::int32_t radius;  ///< at the coarsest level [px]
    std::int32_t candidates, steps;
    float perLastFrame;            ///< this level's pixels per pixel of the last frame's field
    float lastFrameX, lastFrameY;  ///< its cells per cell
    std::int32_t firstGroup;       ///< in lists[]
    std::int32_t errors;           ///< two-way errors; -1: not at this level
};

/// Of flow_propagate.comp and flow_align.comp.
struct alignas(16) RefineFlow {
    LumaLevel from, to;
    std::int32_t columns, rows;
    std::int32_t target, source;
    std::int32_t steps;
};

struct alignas(16) FilterFlow {
    std::int32_t columns, rows;
    std::int32_t target, source;
    std::int32_t planeFits;  ///< rounds
    std::int32_t byTile;     ///< 1: a workgroup is a tile
};

struct alignas(16) FlagTiles {
    std::int32_t tileColumns, tileRows;
    std::int32_t columns, rows;  ///< of cells
    std::int32_t field, errors;
    float leastTexture;  ///< [grey levels^2]
};

struct alignas(16) ListTiles {
    std::int32_t tileColumns, tileRows;
    std::int32_t groupColumns, groupRows;
    std::int32_t tilesPerGroup;   ///< along an axis
    std::int32_t margin;          ///< [tiles]
    std::int32_t command, first;  ///< in commands[] and lists[]
};

}  // namespace mfar::params
