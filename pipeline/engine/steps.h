#pragma once

#include "base/geometry.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/engine/cells.h"
#include "pipeline/engine/field.h"
#include "pipeline/engine/params/layer.h"
#include "pipeline/enlarge/still_tone.h"
#include "pipeline/flow/flow_options.h"
#include "pipeline/flow/luma_layout.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/quality.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

// Interfaces of the steps that process a frame. Both engines implement them. Steps allocate memory
// in their constructors, for a new still, and when an option or a Field's copy is first needed, but
// not in every frame. The result of run() is valid until the next run() of the same step.

namespace mfar {

class FilterBank;
struct FineMatch;
class PlaneImporter;

struct VideoFrame {
    const ImageView& view;
    const RgbPlanes& planes;
    std::uint64_t number;
};

struct StillPictures {
    std::uint64_t number = 0;
    StereoRig rig;   ///< its still camera has the resolution of `raised` and `pairs`
    StillTone tone;  ///< the tone curve that was applied to `luma`, `raised` and `pairs`
    Field<std::uint8_t> luma;
    // Luma with amplified finest detail, see params::kLinearLoss. The GLES engine fills only
    // `raised`. The SIMD engine fills only `pairs`: the low byte is a pixel, and the high byte is
    // the pixel below it.
    Field<std::uint8_t> raised;
    Field<std::uint16_t> pairs;
    Field<std::uint32_t> picture;  ///< RGBA8, only for SuperResMode::Blend
};

/// Luma pyramids of the video and of the still. The still is first brought to the video's geometry
/// and resolution.
struct LumaPyramid {
    std::vector<LumaLevel> video, still;
    Field<std::uint32_t> words;  ///< pixels of both pyramids in one row, see LumaLevel
};

/// Flow between video and still. `cells` contains first the forward field (from video to still),
/// then the backward field (from still to video). If `errorsGiven` is true, there is no backward
/// field; the forward field's ErrorCells are in its place.
struct FlowCells {
    Field<FlowCell> cells;
    Size forward, backward;
    int backwardLevel = 0;
    bool errorsGiven = false;

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(forward.width) * forward.height;
    }
};

struct CellWeights {
    Field<WeighedCell> weighed;
    Field<LookUpCell> lookUps;
    Field<TrustCell> trust;
};

class StillStep {
public:
    virtual ~StillStep() = default;
    /// The still must be valid and have the still camera's size. `tone` is applied to its luma.
    /// `noise`: standard deviation of its noise [grey levels], which is removed from `raised` and
    /// `pairs`, but not from `luma`, so that learned filters do not depend on how it is removed.
    virtual const StillPictures& run(const ImageView& still, SuperResMode mode,
                                     const StillTone& tone, double noise) = 0;
    /// Prepares the members of StillPictures that the new mode needs. They are computed from the
    /// still of the last run().
    virtual void setMode(SuperResMode mode) = 0;
};

class PyramidStep {
public:
    virtual ~PyramidStep() = default;
    /// Computes the video's pyramid. Does nothing if no changed tile is matched with a still, see
    /// TileWork::matched.
    virtual const LumaPyramid& video(const VideoFrame& frame, const TileWork& work) = 0;
    /// Computes the still's pyramid. `light`: Guidance::light.
    virtual const LumaPyramid& still(const StillPictures& still, float light) = 0;
};

class FlowStep {
public:
    using Cells = std::span<const std::array<float, 4>>;
    /// Flow along epipolar lines. In each entry of `vectors`, the first two numbers are the cell's
    /// flow [px]. In each entry of `errors`, the first number is the cell's two-way error [px].
    struct AlongLines {
        Cells vectors, errors;
    };
    struct Pictures {
        const VideoFrame& video;
        const StillPictures& still;
        float light = 0;  ///< Guidance::light
    };

    virtual ~FlowStep() = default;
    /// Sets the options that can change between frames, see changed() in flow_options.h. Throws
    /// std::invalid_argument if an option is out of range.
    virtual void setOptions(const Flow2dOptions& options) = 0;
    /// Searches the flow from video to still (forward) and from still to video (backward). If
    /// `usePrior` is true, the last frame's forward flow vectors are candidates for the forward
    /// flow in all cells. Finally, the forward flow is corrected by comparison with the still at
    /// its full resolution, see params::kSubpixelReach. `luma` must contain the pyramids of
    /// `pictures`. If no changed tile is matched, the last result stays.
    virtual const FlowCells& run(const Pictures& pictures, const LumaPyramid& luma,
                                 const TileWork& work, bool usePrior) = 0;
    /// Refines `along`, the flow along epipolar lines. On static surfaces, its vectors must be
    /// right to within a pixel. First, tiles in which the flow does not fit the pictures are
    /// searched in two dimensions. Then, doubtful cells are compared with the still at its full
    /// resolution, see params::kPatchSamples. Finally, the flow is corrected as by run(). `luma`
    /// must contain the pyramids of `pictures`. If `usePrior` is true, unchanged tiles may keep the
    /// last frame's result. If no changed tile is matched, all of the last result stays.
    virtual const FlowCells& refine(const Pictures& pictures, const LumaPyramid& luma,
                                    const TileWork& work, const AlongLines& along,
                                    bool usePrior) = 0;
    /// Returns a flag for each tile, row-major: true if the last call was refine() and it searched
    /// the tile in two dimensions. After run(), all flags are false. Waits for the GPU if needed.
    [[nodiscard]] virtual std::vector<bool> searchedTiles() const = 0;
    [[nodiscard]] virtual int searchedCount() const = 0;
    /// Returns searchedCount() of a recent frame, without waiting for the GPU. With the SIMD
    /// engine, this is the last frame. With the GLES engine, it is the frame before the last one.
    [[nodiscard]] virtual int finishedSearchedCount() const { return searchedCount(); }
};

class WeighStep {
public:
    virtual ~WeighStep() = default;
    virtual const CellWeights& run(const LumaPyramid& luma, const FlowCells& flow,
                                   const TileWork& work) = 0;
    /// Raises all weights below 1. Then lowers the weights of cells in which the still shows the
    /// video's finest detail less well than usual; `match` describes the usual case. See
    /// params::kFineRoom. Must be called after run() for the same frame.
    virtual const CellWeights& confirm(const VideoFrame& frame, const StillPictures& still,
                                       const TileWork& work, const FineMatch& match) = 0;
};

struct TileSummary {
    std::array<int, kTileClasses> tiles{};
    double meanConfidence = 0;
    /// Share of the tiles that count as explained by a still, [0, 1]. Unexplained tiles are those
    /// in which params::kUnexplainedCells or more cells have structure, but no reliable match. In
    /// frames that are drawn without a still, all drawn tiles are unexplained.
    double explained = 0;
    int second = 0;  ///< number of tiles that show some of the second still
};

struct DetailOptions {
    SuperResMode mode = SuperResMode::Detail;
    bool cubic = true;
    bool enlargedTiles = true;
    bool plainTiles = true;
    /// Filters for Quality::learned. Null: the video is enlarged without learned filters.
    const FilterBank* filters = nullptr;
};

class DetailStep {
public:
    struct Matched {
        const StillPictures& still;
        const CellWeights& weights;
        /// A second still, or null. It is shown where its weight exceeds the weight of `still` by
        /// more than params::kSecondFrom. It is used only in mode Detail with learned filters.
        const Matched* second = nullptr;
    };

    virtual ~DetailStep() = default;
    /// Draws the tiles that `work` requests; the other tiles keep their pixels. If `matched` is
    /// null, the video is only enlarged.
    virtual void draw(const VideoFrame& frame, const Matched* matched, const TileWork& work,
                      const DetailOptions& options) = 0;
    /// The output picture: RGBA8, row 0 on top, alpha 255. If other code changes its pixels in the
    /// memory of this step's engine, they stay changed until draw() draws their tiles again. If
    /// other code changes a copy in the other memory (CPU or GPU), the next draw() of a frame with
    /// a changed tile discards all of these changes.
    [[nodiscard]] virtual Field<std::uint32_t>& output() = 0;
    /// Summary of the last frame. Waits for the GPU if necessary.
    [[nodiscard]] virtual TileSummary summary() const = 0;
    /// Returns a summary without waiting for the GPU. With the SIMD engine, it is that of the last
    /// frame. With the GLES engine, it is that of the frame before the last one.
    [[nodiscard]] virtual TileSummary finishedSummary() const { return summary(); }
    [[nodiscard]] virtual std::vector<TileClass> classes() const = 0;
};

using params::kShadowLift;

/// A picture of the virtual objects only, as the video camera sees them. It may have fewer pixels
/// than the output.
struct LayerPicture {
    Field<std::uint32_t> colour;  ///< RGBA8, premultiplied by coverage
    Field<float> depth;           ///< z along the camera's axis [m]; 0 where there is no object
    PixelRect bounds;             ///< bounds of the covered layer pixels; empty: nothing is drawn
};

class OcclusionStep {
public:
    virtual ~OcclusionStep() = default;
    /// Draws the virtual objects over `picture`, except where the real scene hides them. `real` is
    /// the depth of the real scene. Outside the rectangle `where` [video px], it must be unknown.
    virtual void draw(const LayerPicture& layer, const InverseDepthField& real,
                      const PixelRect& where, const VideoFrame& frame,
                      Field<std::uint32_t>& picture) = 0;
    /// Returns the visibility of the layer after the last draw(), [0, 1], one entry per output
    /// pixel. Only entries within the layer's bounds are valid. Waits for the GPU if necessary.
    [[nodiscard]] virtual std::vector<float> visibility() const = 0;
};

}  // namespace mfar
