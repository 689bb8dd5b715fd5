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

// The steps of a frame, which both engines implement: as GLES shaders and as SIMD kernels. The
// constructor of a step allocates all memory that the step needs. The result of run() is valid
// until the next run() of the same step.

namespace mfar {

class FilterBank;
struct FineMatch;
class PlaneImporter;

/// A frame of the video camera in its original format, and its colours as planes.
struct VideoFrame {
    const ImageView& view;
    const RgbPlanes& planes;
    std::uint64_t number;  ///< each frame has its own number
};

/// The newest still, prepared for the other steps.
struct StillPictures {
    std::uint64_t number = 0;  ///< each still has its own number
    StereoRig rig;             ///< its still camera has the resolution of the fields below
    StillTone tone;            ///< the tone curve that was applied to luma, raised and pairs
    Field<std::uint8_t> luma;  ///< luma of the whole still
    // Luma whose finest detail is amplified, see params::kLinearLoss. An engine fills the one of
    // these two fields that has its format, and leaves the other empty.
    Field<std::uint8_t> raised;    ///< from the GLES engine
    Field<std::uint16_t> pairs;    ///< from the SIMD engine; low byte: a pixel; high byte: the
                                   ///< pixel below it
    Field<std::uint32_t> picture;  ///< RGBA8; only for SuperResMode::Blend
};

/// Inputs of the flow step: the luma pyramid of the video, and that of the still in the geometry
/// and resolution of the video.
struct LumaPyramid {
    std::vector<LumaLevel> video, still;
    Field<std::uint32_t> words;  ///< pixels of both pyramids, in one row; see LumaLevel
};

/// Flow between video and still. All cells are in one row: first the forward field (from video to
/// still), then the backward field. If `errorsGiven`, the row has the two-way errors of the forward
/// cells (ErrorCell) instead of the backward field.
struct FlowCells {
    Field<FlowCell> cells;
    Size forward, backward;  ///< columns, rows
    int backwardLevel = 0;   ///< pyramid level of the backward field
    bool errorsGiven = false;

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(forward.width) * forward.height;
    }
};

/// How far the still is trusted at each cell.
struct CellWeights {
    Field<WeighedCell> weighed;
    Field<LookUpCell> lookUps;
    Field<TrustCell> trust;
};

class StillStep {
public:
    virtual ~StillStep() = default;
    /// Prepares a still for the other steps. The still must be valid and have the still camera's
    /// size. `tone` is applied to its luma.
    virtual const StillPictures& run(const ImageView& still, SuperResMode mode,
                                     const StillTone& tone) = 0;
    /// Prepares the fields that another mode needs, from the still of the last run().
    virtual void setMode(SuperResMode mode) = 0;
};

class PyramidStep {
public:
    virtual ~PyramidStep() = default;
    /// Computes the pyramid of the frame. Does nothing if no tile of the frame is matched with a
    /// still.
    virtual const LumaPyramid& video(const VideoFrame& frame, const TileWork& work) = 0;
    virtual const LumaPyramid& still(const StillPictures& still) = 0;
};

class FlowStep {
public:
    using Cells = std::span<const std::array<float, 4>>;

    virtual ~FlowStep() = default;
    /// Takes over only those options that may change between frames, see changed() in
    /// flow_options.h. Throws std::invalid_argument if an option is out of range.
    virtual void setOptions(const Flow2dOptions& options) = 0;
    /// Searches the flow from video to still (forward) and from still to video (backward).
    /// `usePrior`: the flow of the last frame is a candidate for every cell.
    virtual const FlowCells& run(const LumaPyramid& luma, const TileWork& work, bool usePrior) = 0;
    /// Refines `vectors`, the flow of each cell with an error of less than a pixel. `errors`: the
    /// first number of each entry is the two-way error of the cell's vector [px]. Tiles in which
    /// the vectors prove to be wrong are searched in both dimensions.
    virtual const FlowCells& refine(const LumaPyramid& luma, const TileWork& work, Cells vectors,
                                    Cells errors) = 0;
    /// Returns a flag for each tile, row-major: true if the last refine() searched the tile. May
    /// wait for the GPU.
    [[nodiscard]] virtual std::vector<bool> searchedTiles() const = 0;
    [[nodiscard]] virtual int searchedCount() const = 0;
    /// searchedCount() for a frame whose results exist already, so that the call does not wait: on
    /// a CPU the last frame, on a GPU the frame before it.
    [[nodiscard]] virtual int finishedSearchedCount() const { return searchedCount(); }
};

class WeighStep {
public:
    virtual ~WeighStep() = default;
    virtual const CellWeights& run(const LumaPyramid& luma, const FlowCells& flow,
                                   const TileWork& work) = 0;
    /// Lowers the weights of cells where the still shows less of the video's finest detail than
    /// expected. Must be called after run() on the same frame. `match`: how much is expected, see
    /// params::kFineRoom.
    virtual const CellWeights& confirm(const VideoFrame& frame, const StillPictures& still,
                                       const TileWork& work, const FineMatch& match) = 0;
};

/// Statistics of one frame.
struct TileSummary {
    std::array<int, kTileClasses> tiles{};  ///< number of tiles of each TileClass
    double meanConfidence = 0;              ///< [0, 1]
    double explained = 0;  ///< share of tiles that are flat or match a still, [0, 1]
    double changed = 0;    ///< share of tiles that were drawn, [0, 1]
    int second = 0;        ///< number of tiles that show parts of the second still
};

struct DetailOptions {
    SuperResMode mode = SuperResMode::Detail;
    bool cubic = true;          ///< Quality::cubic
    bool upscaledTiles = true;  ///< SkipOptions::upscaledTiles
    bool plainTiles = true;     ///< SkipOptions::plainTiles
    /// Filters for Quality::learned; null: the video is enlarged without learned filters.
    const FilterBank* filters = nullptr;
};

class DetailStep {
public:
    /// A still, and how far it is trusted at each cell.
    struct Matched {
        const StillPictures& still;
        const CellWeights& weights;
        /// A second still, which is shown where its weight is larger than that of `still`; null:
        /// there is none. Used only in mode Detail with learned filters.
        const Matched* second = nullptr;
    };

    virtual ~DetailStep() = default;
    /// Draws the tiles that `work` requests; the other tiles keep their pixels. If `matched` is
    /// null, the video is only enlarged.
    virtual void draw(const VideoFrame& frame, const Matched* matched, const TileWork& work,
                      const DetailOptions& options) = 0;
    /// The output picture: RGBA8, row 0 on top, alpha 255. Pixels that other code draws into it
    /// remain until draw() redraws their tiles.
    [[nodiscard]] virtual Field<std::uint32_t>& output() = 0;
    /// Summary of the last frame. May wait for the GPU.
    [[nodiscard]] virtual TileSummary summary() const = 0;
    /// Summary of a frame whose results exist already, so that the call does not wait: on a CPU the
    /// last frame, on a GPU the frame before it.
    [[nodiscard]] virtual TileSummary finishedSummary() const { return summary(); }
    /// Class of every tile in the last frame, row-major. May wait for the GPU.
    [[nodiscard]] virtual std::vector<TileClass> classes() const = 0;
};

using params::kShadowLift;

/// A picture of the virtual objects only, as the video camera sees them. It may have fewer pixels
/// than the output.
struct LayerPicture {
    Field<std::uint32_t> colour;  ///< RGBA8, premultiplied by coverage
    Field<float> depth;           ///< z along the camera's axis [m]; 0: no object
    PixelRect bounds;             ///< bounds of the covered pixels of the layer
};

class OcclusionStep {
public:
    virtual ~OcclusionStep() = default;
    /// Draws the virtual objects over `picture`, except where the real scene hides them. `real`:
    /// depth of the real scene; it is unknown outside the rectangle `where` [video px].
    virtual void draw(const LayerPicture& layer, const InverseDepthField& real,
                      const PixelRect& where, const VideoFrame& frame,
                      Field<std::uint32_t>& picture) = 0;
    /// Returns how visible the layer was in the last draw(), [0, 1], for each output pixel within
    /// the layer's bounds. May wait for the GPU.
    [[nodiscard]] virtual std::vector<float> visibility() const = 0;
};

}  // namespace mfar
