#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// Parameters of the 2-D flow, used by flow_*.comp and by the SIMD code of the same steps.
// gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

/// Search radius at the coarsest pyramid level [px] if the last frame's flow is a candidate. It is
/// small, because then only moving objects need a search.
inline constexpr int kTrackingRadius = 3;
/// Search radius at the coarsest pyramid level [px] in tiles whose content does not match along its
/// epipolar lines. 5 px there are 80 px of the frame. Twice the radius would find objects that have
/// moved farther since the still, but cost four times as much.
inline constexpr int kListedRadius = 5;
/// Number of Gauss-Newton steps from a neighbour's flow vector, if it costs less than the cell's
/// own.
inline constexpr int kPropagateSteps = 2;
/// Number of Gauss-Newton steps from a flow vector whose error is less than a pixel. Four steps are
/// not more accurate.
inline constexpr int kAlignSteps = 2;
/// Finest pyramid level of the backward field. This level suffices, because the backward field only
/// verifies the forward field: an error of a tenth of a pixel at this level is only a tenth of
/// alpha in eq. 2 of the paper.
inline constexpr int kBackwardFinest = 1;
inline constexpr int kBackwardPropagations = 1;

/// The cost of an 8x8 patch is meaningful if the patch's texture (see FlowCell) exceeds this factor
/// times the variance of the noise. The factor is eight times the number of pixels of a patch.
inline constexpr float kTexturePerVariance = 8.0F * kPatchPixels;
inline constexpr float kUnexplainedCost = 0.4F;
/// Cells with at least this two-way error [px] are outside the still and are not searched. Occluded
/// cells, which have a smaller error, are searched: the z-test that finds occlusions uses depths
/// from epipolar lines, and these depths are wrong for moving objects.
inline constexpr float kNotShown = 100.0F;
/// A tile is searched in both dimensions if at least this number of its 16 cells is unexplained.
inline constexpr int kLeastUnexplained = 3;

/// For a cell of a moving object, the z-test is meaningless. The cell's two-way error is therefore
/// estimated from the cost of its match: 0 px up to kGoodCost, then kErrorPerCost px per unit of
/// cost. The cell is not trusted at all if this error reaches alpha in eq. 2 of the paper.
inline constexpr float kGoodCost = 0.1F;
inline constexpr float kErrorPerCost = 5.0F;
/// Largest distance of a flow vector from the vector found along the epipolar line [px] at which it
/// counts as the same match.
inline constexpr float kOnLine = 1.0F;
/// A cell gets a flow vector off its epipolar line only if this vector costs less than this factor
/// times the cost on the line, because one of many vectors may fit noise by chance.
inline constexpr float kClearlyLess = 0.5F;

/// Largest change of the flow within one surface [px per px]; a larger change is a depth edge.
inline constexpr float kSteepestFlow = 0.25F;

/// A plane is fitted to the flow of the cells within this distance along each axis [cells].
inline constexpr int kCleanUpRadius = 2;
/// A neighbour whose flow differs from the fitted plane by more than this [px] belongs to another
/// surface. kFirstPlaneReach applies in the first round; it is wider, because the slope of the
/// plane is not known yet.
inline constexpr float kFirstPlaneReach = 1.2F;
inline constexpr float kPlaneReach = 0.5F;
/// Texture of a patch (see FlowCell) [grey levels^2] at which its cell has half of the full weight.
inline constexpr float kHalfTrusted = 2000.0F;
/// Weight of a cell that has no texture or whose match has a high cost.
inline constexpr float kLeastPlaneWeight = 1e-4F;
/// Damping of a plane's slopes, added to the diagonal of the equations: a constant, and an amount
/// per unit of weight. It is needed because a single neighbour does not determine a plane.
inline constexpr float kSlopeDamping = 0.5F;
inline constexpr float kSlopeDampingPerWeight = 0.05F;

/// Parameters of flow_search.comp. The field members (target, coarser, lastFrame, errors) are
/// indices: a field is a part of cells[] and is identified by the index of its first cell.
struct alignas(16) SearchFlow {
    LumaLevel from, to;  ///< pyramid level of the patches, and pyramid level of the picture that is
                         ///< searched
    std::int32_t columns, rows;
    std::int32_t coarserColumns, coarserRows;
    std::int32_t target;
    std::int32_t coarser;    ///< field of the next coarser pyramid level; -1: this is the coarsest
    std::int32_t lastFrame;  ///< field of the last frame; -1: not used
    std::int32_t lastFrameColumns;
    std::int32_t radius;  ///< search radius at the coarsest pyramid level [px]
    std::int32_t candidates, steps;
    float perLastFrame;            ///< pixels of this pyramid level per pixel of the last frame's
                                   ///< field
    float lastFrameX, lastFrameY;  ///< cells of the last frame's field per cell of this field
    std::int32_t firstGroup;       ///< index of the first group in lists[]
    std::int32_t errors;           ///< field of two-way errors; -1: not used at this pyramid level
};

/// Parameters of flow_propagate.comp and flow_align.comp.
struct alignas(16) RefineFlow {
    LumaLevel from, to;
    std::int32_t columns, rows;
    std::int32_t target, source;
    std::int32_t steps;
};

struct alignas(16) FilterFlow {
    std::int32_t columns, rows;
    std::int32_t target, source;
    std::int32_t planeFits;  ///< number of rounds of plane fits
    std::int32_t byTile;     ///< 1: each workgroup processes one tile, and only matched tiles are
                             ///< filtered
};

struct alignas(16) FlagTiles {
    std::int32_t tileColumns, tileRows;
    std::int32_t columns, rows;  ///< number of cells
    std::int32_t field, errors;
    float leastTexture;  ///< smallest texture of a patch (see FlowCell) at which the cost is
                         ///< meaningful [grey levels^2]
};

struct alignas(16) ListTiles {
    std::int32_t tileColumns, tileRows;
    std::int32_t groupColumns, groupRows;
    std::int32_t tilesPerGroup;   ///< tiles of a group along each axis
    std::int32_t margin;          ///< margin around a group [tiles]
    std::int32_t command, first;  ///< index of the command in commands[], and of the first group in
                                  ///< lists[]
};

}  // namespace mfar::params
