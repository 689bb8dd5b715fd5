#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// Fixed parameters of the 2-D flow: flow_*.comp and their SIMD twins. Shaders read this header,
// too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Search radius when the last frame's field is a candidate: only moving objects need a search.
inline constexpr int kTrackingRadius = 3;
/// Search radius for tiles off their epipolar lines. 5 px are 80 px of the frame; objects that have
/// moved farther since the still do not justify a search that costs four times as much.
inline constexpr int kListedRadius = 5;
/// Gauss-Newton steps after a neighbour's vector fits better.
inline constexpr int kPropagateSteps = 2;
/// Gauss-Newton steps from a vector whose error is a fraction of a pixel; four steps gain nothing.
inline constexpr int kAlignSteps = 2;
/// Finest level of the backward field, which only verifies: a tenth of a pixel at this level is a
/// tenth of eq. 2's alpha.
inline constexpr int kBackwardFinest = 1;
inline constexpr int kBackwardPropagations = 1;

/// Energy of an 8x8 patch above which its cost is meaningful, per variance of the noise [grey
/// levels^2]: eight times the noise's energy.
inline constexpr float kTexturePerVariance = 8.0F * kPatchPixels;
inline constexpr float kUnexplainedCost = 0.4F;
/// Two-way error [px] of cells outside the still. Occluded cells are searched, too: the z-test uses
/// depths from epipolar lines and fails for moving objects.
inline constexpr float kNotShown = 100.0F;
/// Lower limit of the unexplained cells, of 16, of a tile that is searched.
inline constexpr int kLeastUnexplained = 3;

/// The z-test is meaningless for moving objects: their cells are trusted by their cost, from fully
/// (kGoodCost) to not at all (where the error reaches alpha of eq. 2).
inline constexpr float kGoodCost = 0.1F;
inline constexpr float kErrorPerCost = 5.0F;
/// Upper limit of the distance between a vector and its epipolar line's vector [px].
inline constexpr float kOnLine = 1.0F;
/// Factor by which the cost must be lower for a cell to leave its line: among many vectors one fits
/// noise by chance.
inline constexpr float kClearlyLess = 0.5F;

/// Largest change of the flow across a surface [px per px]; a larger one is a depth edge.
inline constexpr float kSteepestFlow = 0.25F;

/// Plane fits use the cells up to this distance in each direction.
inline constexpr int kCleanUpRadius = 2;
/// Neighbours that differ from the plane by more than this [px] belong to another surface. The
/// first round does not know the slope yet, so its limit is wider.
inline constexpr float kFirstPlaneReach = 1.2F;
inline constexpr float kPlaneReach = 0.5F;
/// Texture energy of a patch at which it has half of the full weight [grey levels^2].
inline constexpr float kHalfTrusted = 2000.0F;
/// Weight of a cell without texture or with a high cost.
inline constexpr float kLeastPlaneWeight = 1e-4F;
/// Damping of the slopes, added to their diagonal: a constant part and a part per unit of weight,
/// because a single neighbour does not determine a plane.
inline constexpr float kSlopeDamping = 0.5F;
inline constexpr float kSlopeDampingPerWeight = 0.05F;

/// Fields are areas of patches[], identified by the index of their first cell.
struct alignas(16) SearchFlow {
    LumaLevel from, to;  ///< source of the patches, picture that is searched
    std::int32_t columns, rows;
    std::int32_t coarserColumns, coarserRows;
    std::int32_t target;
    std::int32_t coarser;    ///< field of the coarser level; -1: this is the coarsest
    std::int32_t lastFrame;  ///< field of the last frame; -1: none
    std::int32_t lastFrameColumns;
    std::int32_t radius;  ///< at the coarsest level [px]
    std::int32_t candidates, steps;
    float perLastFrame;            ///< this level's pixels per pixel of the last frame's field
    float lastFrameX, lastFrameY;  ///< cells of the last frame's field per cell
    std::int32_t firstGroup;       ///< in lists[]
    std::int32_t errors;           ///< two-way errors; -1: not used at this level
};

/// For flow_propagate.comp and flow_align.comp.
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
    std::int32_t tilesPerGroup;   ///< along each axis
    std::int32_t margin;          ///< [tiles]
    std::int32_t command, first;  ///< in commands[] and lists[]
};

}  // namespace mfar::params
