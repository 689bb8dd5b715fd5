#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// Parameters of the 2-D flow in the shaders flow_*.comp and in the SIMD code. params_to_glsl.cmake
// translates this header to GLSL.
namespace mfar::params {

/// Search radius at the coarsest pyramid level [px] if the last frame's flow is a candidate. It is
/// small, because only moving objects still need the search then.
inline constexpr int kTrackingRadius = 3;
/// Search radius at the coarsest pyramid level [px] in tiles without a reliable match along
/// epipolar lines. 5 px at this level are 80 px of a frame of 640x480. Twice the radius would find
/// objects that have moved farther since the still, but would take four times as long.
inline constexpr int kListedRadius = 5;
/// Number of Gauss-Newton steps from a neighbour's flow vector that costs less than the cell's own.
inline constexpr int kPropagateSteps = 2;
/// Number of Gauss-Newton steps from a flow vector whose error is less than a pixel. Four steps are
/// not more accurate.
inline constexpr int kAlignSteps = 2;
/// Finest pyramid level of the backward field. The full resolution is not necessary, because this
/// field only verifies the forward field: a typical error of 0.1 px at this level is 0.2 video px,
/// a tenth of the two-way error at which the confidence becomes zero (kTwoWayAlpha).
inline constexpr int kBackwardFinest = 1;
inline constexpr int kBackwardPropagations = 1;

/// The cost of an 8x8 patch is meaningful if the patch's texture (see FlowCell) exceeds this
/// multiple of the noise variance. The variance of its pixels is then above 8 times that of noise.
inline constexpr float kTexturePerVariance = 8.0F * kPatchPixels;
inline constexpr float kUnexplainedCost = 0.4F;
/// Cells with at least this two-way error [px] are outside the still and are not searched. Cells
/// that seem to be occluded have a smaller error. They are searched, because they can belong to a
/// moving object. Its depth from epipolar lines is wrong, so the test for occlusion is wrong, too.
inline constexpr float kNotShown = 100.0F;
/// A tile is searched in both dimensions if at least this number of its 16 cells has no reliable
/// match.
inline constexpr int kLeastUnexplained = 3;

/// Two-way error [px] of a cell of a moving object. The test for occlusion is meaningless for such
/// a cell, so the error is computed from the match's cost: max(cost - kGoodCost, 0) *
/// kErrorPerCost.
inline constexpr float kGoodCost = 0.1F;
inline constexpr float kErrorPerCost = 5.0F;
/// A flow vector within this distance [px] of the match along the epipolar line is the same match.
inline constexpr float kOnLine = 1.0F;
/// A cell gets a flow vector off its epipolar line only if the vector costs less than this fraction
/// of the cost on the line. Otherwise, one of many vectors may fit noise by chance.
inline constexpr float kClearlyLess = 0.5F;

/// The pyramids contain the still reduced to the video's resolution. Fine print and gravel are so
/// fine that they alias in the video, and they alias differently in the reduced still, because its
/// pixels lie elsewhere. Correct matches then have a high cost, and Gauss-Newton steps move away
/// from them. Doubtful cells are therefore also compared with the still itself: its mean over each
/// video pixel, from kPatchSamples samples along each axis, aliases as the video does.
inline constexpr int kPatchSamples = 2;
/// The flow along the epipolar line replaces the refined flow if its squared correlation with the
/// still itself is larger by more than this. Below this margin, the difference may be noise, and in
/// noise the refined flow is more accurate.
inline constexpr float kClearlyAlike = 0.05F;
/// The flow along the epipolar line is smoothed before the comparison with the still itself: a cell
/// gets the mean over pairs of opposite neighbours up to kCleanUpRadius cells away. On a plane,
/// each pair's mean is the flow at the cell. A pair whose mean differs from the median around the
/// cell by this [px] or more is on another surface and is left out.
inline constexpr float kPairReach = 0.5F;
/// If the distance of two flow vectors is at most this [px], only one of them is compared.
inline constexpr float kSameFlow = 0.05F;

/// Largest change of the flow within one surface [px per px]. A larger change is a depth edge.
inline constexpr float kSteepestFlow = 0.25F;

/// A plane is fitted to the flow of cells within this distance along each axis [cells].
inline constexpr int kCleanUpRadius = 2;
/// A neighbour whose flow differs from the fitted plane by more than kPlaneReach [px] belongs to
/// another surface. The first fit uses kFirstPlaneReach instead, because the plane's slope is not
/// known yet.
inline constexpr float kFirstPlaneReach = 1.2F;
inline constexpr float kPlaneReach = 0.5F;
/// A cell whose patch has this texture (see FlowCell) has half of the full weight in the fit [grey
/// levels^2].
inline constexpr float kHalfTrusted = 2000.0F;
inline constexpr float kLeastPlaneWeight = 1e-4F;
/// Damping of a plane's slopes, because a single neighbour does not determine them. The sum
/// kSlopeDamping + kSlopeDampingPerWeight * (sum of weights) is added to the equations' diagonal.
inline constexpr float kSlopeDamping = 0.5F;
inline constexpr float kSlopeDampingPerWeight = 0.05F;

/// Parameters of flow_search.comp. Each flow field is a part of the array cells[]. The members
/// target, coarser, lastFrame and errors are indices of a field's first cell, or -1 if there is no
/// such field.
struct alignas(16) SearchFlow {
    /// Pyramid levels of the patches and of the searched picture.
    LumaLevel from, to;
    std::int32_t columns, rows;
    std::int32_t coarserColumns, coarserRows;
    std::int32_t target;
    std::int32_t coarser;
    std::int32_t lastFrame;
    std::int32_t lastFrameColumns;
    std::int32_t radius;
    std::int32_t candidates, steps;
    /// Factor from the last frame's flow to pixels of the searched pyramid level.
    float perLastFrame;
    /// Number of columns and rows of the last frame's field divided by that of the target field.
    float lastFrameX, lastFrameY;
    std::int32_t firstGroup;
    std::int32_t errors;
};

struct alignas(16) RefineFlow {
    LumaLevel from, to;
    std::int32_t columns, rows;
    std::int32_t target, source;
    std::int32_t steps;
};

struct alignas(16) FilterFlow {
    std::int32_t columns, rows;
    std::int32_t target, source;
    std::int32_t planeFits;
    /// 1: each workgroup processes one tile, and only matched tiles are filtered (finest pyramid
    /// level). 0: all cells are filtered.
    std::int32_t byTile;
};

struct alignas(16) CompareDirectly {
    Rig rig;
    std::int32_t columns, rows;
    std::int32_t videoWidth, videoHeight;
    std::int32_t target, source, errors;
    float noise;
    float texelX, texelY;
    /// Smallest texture of a patch (see FlowCell) for which the cost is meaningful [grey levels^2].
    float leastTexture;
};

struct alignas(16) FlagTiles {
    std::int32_t tileColumns, tileRows;
    std::int32_t columns, rows;
    std::int32_t field, errors;
    /// Smallest texture of a patch (see FlowCell) for which the cost is meaningful [grey levels^2].
    float leastTexture;
};

struct alignas(16) ListTiles {
    std::int32_t tileColumns, tileRows;
    std::int32_t groupColumns, groupRows;
    std::int32_t tilesPerGroup;
    std::int32_t margin;  ///< a group is listed if a flagged tile is within this distance [tiles]
    /// Index of the command in commands[] and of the first group in lists[].
    std::int32_t command, first;
};

}  // namespace mfar::params
