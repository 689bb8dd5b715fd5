#pragma once

#include "pipeline/engine/params/luma.h"
#include "pipeline/engine/params/patch.h"

#include <cstdint>

// Parameters of the 2-D flow in the shaders flow_*.comp and in the SIMD code. params_to_glsl.cmake
// translates this header to GLSL.
namespace mfar::params {

/// Search radius at the coarsest pyramid level [px] if the last frame's flow is known. A small
/// radius suffices, because the last frame's flow is tried first and fails only on moving objects.
inline constexpr int kTrackingRadius = 3;
/// Largest search radius at the coarsest pyramid level [px] in tiles without a reliable match along
/// epipolar lines. (The radius is Flow2dOptions::searchRadius if that is smaller.) For video of
/// 640x480, 5 px at this level are 80 px at full size. Twice the radius would find objects that
/// have moved farther since the still, but would take four times as long.
inline constexpr int kListedRadius = 5;
/// A cell tries the flow vectors of its neighbours. If the best of them has a lower cost than the
/// cell's own vector, the cell adopts it, and this number of Gauss-Newton steps improves it.
inline constexpr int kPropagateSteps = 2;
/// Number of Gauss-Newton steps that improve a flow vector whose error is already less than a
/// pixel. Four steps would not make it more accurate.
inline constexpr int kAlignSteps = 2;
/// Finest pyramid level of the backward field (flow from still to video). Half resolution suffices,
/// because this field only verifies the forward field. A typical error at this level is 0.1 px,
/// which is 0.2 video px. The confidence becomes zero at a ten times larger two-way error
/// (kTwoWayAlpha).
inline constexpr int kBackwardFinest = 1;
inline constexpr int kBackwardPropagations = 1;

/// The cost of an 8x8 patch is meaningful if the patch's texture (see FlowCell) exceeds this factor
/// times (noise variance + 1) [grey levels^2]. The variance of its pixels is then more than 8 times
/// that of the noise.
inline constexpr float kTexturePerVariance = 8.0F * kPatchPixels;
/// A cell has no reliable match along its epipolar line if its cost is meaningful and above this.
inline constexpr float kUnexplainedCost = 0.4F;
/// A cell with at least this two-way error [px] is outside the still and does not count for
/// kLeastUnexplained. A cell that seems to be occluded has a smaller error and counts, because it
/// may belong to a moving object: for such an object, depth from epipolar lines is wrong, and so is
/// the test for occlusion.
inline constexpr float kNotShown = 100.0F;
/// A tile is searched in two dimensions if at least this number of its 16 cells has no reliable
/// match along epipolar lines. It is also searched if at least two of the four adjacent tiles have
/// that many such cells.
inline constexpr int kLeastUnexplained = 3;

/// A cell is doubtful if its cost is meaningful (see kTexturePerVariance), its two-way error is
/// below kNotShown, and the cost is above kGoodCost or the error is above 0. Doubtful cells are
/// compared again, see kPatchSamples.
///
/// On a moving object, the test for occlusion is meaningless. Therefore, a cell that gets a flow
/// vector off its epipolar line also gets a two-way error [px] that is computed from the vector's
/// cost: max(cost - kGoodCost, 0) * kErrorPerCost. If a doubtful cell costs less in the comparison
/// with the full-size still, its error is limited to the value of this formula for the lower cost.
inline constexpr float kGoodCost = 0.1F;
inline constexpr float kErrorPerCost = 5.0F;
/// A flow vector whose end is within this distance [px] of the match along the epipolar line counts
/// as the same match.
inline constexpr float kOnLine = 1.0F;
/// A cell gets a flow vector off its epipolar line only if the vector's cost is at most this
/// fraction of the cost on the line. A weaker condition would accept vectors that fit noise by
/// chance, because many vectors are tried.
inline constexpr float kClearlyLess = 0.5F;

/// The pyramids contain the still reduced to the video's resolution. Very fine structure, such as
/// print and gravel, aliases in the video and in the reduced still, but differently, because their
/// pixels lie at different places. Correct matches then have a high cost, and Gauss-Newton steps
/// move away from them. Doubtful cells are therefore also compared with the still at its full
/// resolution: it is averaged over each video pixel, with kPatchSamples samples along each axis,
/// and then aliases as the video does.
inline constexpr int kPatchSamples = 2;
/// Each doubtful cell has two candidates: the flow along the epipolar line and the refined flow.
/// The first is chosen only if its squared correlation with the full-size still is larger by more
/// than this. A smaller difference may be noise, and the refined flow is then usually more
/// accurate.
inline constexpr float kClearlyAlike = 0.05F;
/// The flow along the epipolar line is smoothed before the comparison with the full-size still. A
/// cell gets the mean over pairs of opposite neighbours, up to kCleanUpRadius cells away. On a
/// plane, the mean of each pair is the flow at the cell. If the mean of a pair differs from the
/// median around the cell by kPairReach [px] or more, the pair is on another surface and is left
/// out.
inline constexpr float kPairReach = 0.5F;
/// Two flow vectors whose ends are at most this distance apart [px] count as equal, and only one of
/// them is compared.
inline constexpr float kSameFlow = 0.05F;

/// Largest change of the flow within one surface [px per px]. A larger change is a depth edge.
inline constexpr float kSteepestFlow = 0.25F;

/// A patch of 8x8 pixels at a depth edge shows two surfaces, so the flow of a cell beside the edge
/// often belongs to the other surface. If the flow of a neighbour differs from a cell's flow by
/// more than this distance [px], the cell's own 16 pixels are compared with the still at its full
/// resolution: at the cell's flow, and at the flow of each such neighbour.
inline constexpr float kOtherSurface = 0.5F;
/// The cell takes the flow of the neighbour with the lowest error (sum of the squared differences
/// of luma) if that error is below this fraction of the cell's own error. An amount for noise is
/// added to both errors first.
inline constexpr float kClearlyBetter = 0.5F;
/// Variance that is added to that of the video's noise [grey levels^2]. It stands for the errors of
/// the right flow: the still has other noise, and the flow is still off by a fraction of a pixel.
inline constexpr float kChoiceVariance = 4.0F;

/// Because of aliasing (see kPatchSamples), the flow of most cells is off by about 0.1 px.
/// Therefore, every cell is finally compared with the still at its full resolution, and one
/// Gauss-Newton step corrects its flow. The derivative of the still along x is the mean over a
/// square whose centre is half a pixel further right, minus the mean over a square whose centre is
/// half a pixel further left. The derivative along y is computed in the same way. The kind of mean
/// is that of kSeen: m + light * (r - m), where r is the root of a mean square. The derivative of r
/// is the derivative of the mean square, divided by 2 r. The sums over a cell's pixels count with
/// weight 4, those of the cells beside, above and below it with weight 2, and those of the diagonal
/// neighbours with weight 1.
///
/// The flow of a cell and its change per pixel define a plane. A neighbour was compared at its own
/// flow, so its sums are first converted to the flow that the plane has there. If its flow is
/// kSubpixelReach [px] or more away from the plane, it belongs to another surface and does not
/// count. Below this, its weight decreases with the distance.
inline constexpr float kSubpixelReach = 0.5F;
/// Sum of the weights of all compared pixels: 16 per cell times (4 + 4 * 2 + 4 * 1).
inline constexpr float kSubpixelPixels = 256.0F;
/// Expected error of the flow along each axis [px]. The less of the video the still explains, and
/// the smaller the derivatives are, the more this expectation limits the correction.
inline constexpr float kSubpixelError = 0.07F;
/// A correction of this length [px] or more is not made, because the cell probably does not match.
inline constexpr float kSubpixelLongest = 1.0F;
/// A cell keeps its flow if the factor that fits the still's luma to the video's is below this.
inline constexpr float kLeastSubpixelGain = 0.2F;

/// A plane is fitted to the flow of cells within this distance along each axis [cells].
inline constexpr int kCleanUpRadius = 2;
/// A plane is fitted to the flow around a cell. A neighbour whose flow differs from the plane by
/// kPlaneReach [px] or more belongs to another surface and does not count. For the first fit, the
/// limit is kFirstPlaneReach, because the slope of the plane is not known yet.
inline constexpr float kFirstPlaneReach = 1.2F;
inline constexpr float kPlaneReach = 0.5F;
/// Cells with more texture (see FlowCell) have more weight in the fit. With this texture [grey
/// levels^2], the weight is half of the largest one.
inline constexpr float kHalfTrusted = 2000.0F;
inline constexpr float kLeastPlaneWeight = 1e-4F;
/// Damping of the slopes of a fitted plane. It is necessary because a single neighbour does not
/// determine the slopes. The sum kSlopeDamping + kSlopeDampingPerWeight * (sum of weights) is added
/// to the diagonal entries of both slopes in the normal equations.
inline constexpr float kSlopeDamping = 0.5F;
inline constexpr float kSlopeDampingPerWeight = 0.05F;

/// Parameters of flow_search.comp. All flow fields are parts of the array cells[]. The members
/// target, coarser, lastFrame and errors say at which index of cells[] a field begins. -1: there is
/// no such field. In the shader's variant LISTED, the field of the flow along epipolar lines takes
/// the place of the last frame's field, and lastFrame is its index.
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
    /// The last frame's flow vectors are multiplied by this factor to convert them to pixels of the
    /// searched pyramid level.
    float perLastFrame;
    /// lastFrameX: number of columns of the last frame's field per column of the target field.
    /// lastFrameY: the same for rows.
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
    /// 1: each workgroup processes one tile, and cells of tiles that are not matched keep their
    /// flow (finest pyramid level). 0: all cells are filtered.
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

struct alignas(16) ChooseFlow {
    Rig rig;
    std::int32_t columns, rows;
    std::int32_t videoWidth, videoHeight;
    /// Indices in cells[]: of the flow field's first cell, and of the first ErrorCell. -1: there
    /// are no ErrorCells.
    std::int32_t source, errors;
    float texelX, texelY;
    float light;  ///< Guidance::light
    float noise;  ///< standard deviation [grey levels]
};

struct alignas(16) SumSubpixel {
    Rig rig;
    std::int32_t columns, rows;
    std::int32_t source;  ///< index in cells[] of the first cell
    float texelX, texelY;
    float light;  ///< Guidance::light
};

struct alignas(16) CorrectSubpixel {
    std::int32_t columns, rows;
    std::int32_t target;  ///< index in cells[] of the flow field's first cell
    float noise;
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
    /// `command`: index of the command in commands[]. `first`: index of the first group in lists[].
    std::int32_t command, first;
};

}  // namespace mfar::params
