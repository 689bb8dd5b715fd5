#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// Fixed parameters of the 2-D flow: flow_*.comp and the SIMD code of the same steps.
// gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

/// Search radius at the coarsest level [px] if the last frame's flow is a candidate. It is small,
/// because only moving objects need a search then.
inline constexpr int kTrackingRadius = 3;
/// Search radius at the coarsest level [px] in tiles whose content is not on its epipolar lines. 5
/// px are 80 px of the frame. A larger radius would find objects that have moved farther since the
/// still, but cost four times as much.
inline constexpr int kListedRadius = 5;
/// Number of Gauss-Newton steps after the vector of a neighbour was found to fit better.
inline constexpr int kPropagateSteps = 2;
/// Number of Gauss-Newton steps from a vector with an error below a pixel; four steps gain nothing.
inline constexpr int kAlignSteps = 2;
/// Finest level of the backward field. This field only verifies the forward field, and an error of
/// a tenth of a pixel at this level is a tenth of alpha in eq. 2 of the paper.
inline constexpr int kBackwardFinest = 1;
inline constexpr int kBackwardPropagations = 1;

/// The cost of an 8x8 patch is meaningful if the patch's energy [grey levels^2] exceeds this
/// multiple of the noise's variance. That is eight times the energy of the noise in a patch.
inline constexpr float kTexturePerVariance = 8.0F * kPatchPixels;
inline constexpr float kUnexplainedCost = 0.4F;
/// Two-way error [px] that marks cells outside the still, which are not searched. Occluded cells
/// are searched, too: the z-test that finds them uses depths from epipolar lines and fails for
/// moving objects.
inline constexpr float kNotShown = 100.0F;
/// A tile is searched if at least this number of its 16 cells is unexplained.
inline constexpr int kLeastUnexplained = 3;

/// Two-way error of a moving object's cell, for which the z-test is meaningless. The error is
/// estimated from the cost: 0 px up to kGoodCost, and kErrorPerCost px more per unit of cost. The
/// cell is not trusted at all if this error reaches alpha in eq. 2 of the paper.
inline constexpr float kGoodCost = 0.1F;
inline constexpr float kErrorPerCost = 5.0F;
/// A vector whose distance from the vector found on the epipolar line is at most this [px] counts
/// as on the line.
inline constexpr float kOnLine = 1.0F;
/// A cell leaves its epipolar line only if its cost falls below this share of the cost on the line,
/// because one of many vectors may fit noise by chance.
inline constexpr float kClearlyLess = 0.5F;

/// Largest change of the flow on one surface [px per px]; a larger change is a depth edge.
inline constexpr float kSteepestFlow = 0.25F;

/// A plane is fitted to the cells within this distance in each direction.
inline constexpr int kCleanUpRadius = 2;
/// A neighbour that differs from the plane by more than this [px] belongs to another surface. In
/// the first round, the slope of the plane is not known yet, so the limit is wider.
inline constexpr float kFirstPlaneReach = 1.2F;
inline constexpr float kPlaneReach = 0.5F;
/// Texture energy at which a patch has half of the full weight [grey levels^2].
inline constexpr float kHalfTrusted = 2000.0F;
/// Weight of a cell without texture, or with a high cost.
inline constexpr float kLeastPlaneWeight = 1e-4F;
/// Damping of a plane's slopes, added to the diagonal of the equations: a constant, and an amount
/// per unit of weight. It is needed because a single neighbour does not determine a plane.
inline constexpr float kSlopeDamping = 0.5F;
inline constexpr float kSlopeDampingPerWeight = 0.05F;

/// A field is an area of cells[]. The index of its first cell identifies it.
struct alignas(16) SearchFlow {
    LumaLevel from, to;  ///< the patches' picture, and the picture that is searched
    std::int32_t columns, rows;
    std::int32_t coarserColumns, coarserRows;
    std::int32_t target;
    std::int32_t coarser;    ///< field of the coarser level; -1: this is the coarsest
    std::int32_t lastFrame;  ///< field of the last frame; -1: none
    std::int32_t lastFrameColumns;
    std::int32_t radius;  ///< search radius at the coarsest level [px]
    std::int32_t candidates, steps;
    float perLastFrame;            ///< pixels of this level per pixel of the last frame's field
    float lastFrameX, lastFrameY;  ///< cells of the last frame's field per cell of this field
    std::int32_t firstGroup;       ///< index of the first group in lists[]
    std::int32_t errors;           ///< two-way errors; -1: not used at this level
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
    std::int32_t byTile;     ///< 1: a workgroup processes a tile
};

struct alignas(16) FlagTiles {
    std::int32_t tileColumns, tileRows;
    std::int32_t columns, rows;  ///< of cells
    std::int32_t field, errors;
    float leastTexture;  ///< least energy of a meaningful cost [grey levels^2]
};

struct alignas(16) ListTiles {
    std::int32_t tileColumns, tileRows;
    std::int32_t groupColumns, groupRows;
    std::int32_t tilesPerGroup;   ///< tiles of a group along each axis
    std::int32_t margin;          ///< [tiles]
    std::int32_t command, first;  ///< index in commands[], index in lists[]
};

}  // namespace mfar::params
