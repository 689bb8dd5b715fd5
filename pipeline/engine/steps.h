#pragma once

#include "base/geometry.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/engine/cells.h"
#include "pipeline/engine/field.h"
#include "pipeline/engine/params/layer.h"
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

// The steps of a frame that both engines implement, as GLES shaders and as SIMD kernels. A step's
// constructor allocates all memory that it needs; the result of run() is valid until its next
// run().

namespace mfar {

class FilterBank;
struct FineMatch;
class PlaneImporter;

/// A frame of the video sensor as the camera delivered it, and its colours as planes.
struct VideoFrame {
    const ImageView& view;
    const RgbPlanes& planes;
    std::uint64_t number;  ///< unique per frame
};

/// The newest still, prepared for the other steps.
struct StillPictures {
    std::uint64_t number = 0;  ///< unique per still
    StereoRig rig;             ///< with the still camera at the resolution of the fields below
    Field<std::uint8_t> luma;  ///< of the whole still
    // Luma with raised finest detail, see params::kLinearLoss, in the format of the engine that
    // produced it. The other field is empty.
    Field<std::uint8_t> raised;    ///< from the GLES engine
    Field<std::uint16_t> pairs;    ///< from the SIMD engine; the high byte is the pixel below
    Field<std::uint32_t> picture;  ///< RGBA8; only for SuperResMode::Blend
};

/// Luma pyramids of the video and of the still in the video's geometry: the inputs of flow.
struct LumaPyramid {
    std::vector<LumaLevel> video, still;
    Field<std::uint32_t> words;  ///< one row
};

/// Flow between video and still, in one row: first the forward field, then the backward field or,
/// as ErrorCell, the given two-way errors of the forward cells.
struct FlowCells {
    Field<FlowCell> cells;
    Size forward, backward;  ///< columns, rows
    int backwardLevel = 0;   ///< level of the pyramid
    bool errorsGiven = false;

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(forward.width) * forward.height;
    }
};

/// How far the still is trusted, cell by cell.
struct CellWeights {
    Field<WeighedCell> weighed;
    Field<LookUpCell> lookUps;
    Field<TrustCell> trust;
};

class StillStep {
public:
    virtual ~StillStep() = default;
    /// Prepares a valid still of the still camera's size.
    virtual const StillPictures& run(const ImageView& still, SuperResMode mode) = 0;
    /// Adds the fields of the same still that another mode needs.
    virtual void setMode(SuperResMode mode) = 0;
};

class PyramidStep {
public:
    virtual ~PyramidStep() = default;
    /// Does nothing if the frame matches no tile.
    virtual const LumaPyramid& video(const VideoFrame& frame, const TileWork& work) = 0;
    virtual const LumaPyramid& still(const StillPictures& still) = 0;
};

class FlowStep {
public:
    using Cells = std::span<const std::array<float, 4>>;

    virtual ~FlowStep() = default;
    /// See changed() in flow_options.h. Throws std::invalid_argument for options out of range.
    virtual void setOptions(const Flow2dOptions& options) = 0;
    /// Searches both fields. `usePrior`: the last frame's field is a candidate everywhere.
    virtual const FlowCells& run(const LumaPyramid& luma, const TileWork& work, bool usePrior) = 0;
    /// Refines vectors whose error is a fraction of a pixel, one per cell; `errors`: their two-way
    /// errors [px] in the first entry. Tiles with wrong vectors are searched.
    virtual const FlowCells& refine(const LumaPyramid& luma, const TileWork& work, Cells vectors,
                                    Cells errors) = 0;
    /// Tiles that the last refine() searched, row-major. May wait for the GPU.
    [[nodiscard]] virtual std::vector<bool> searchedTiles() const = 0;
    [[nodiscard]] virtual int searchedCount() const = 0;
    /// searchedCount() of a frame that is certainly finished: the last, or on a GPU the one before.
    [[nodiscard]] virtual int finishedSearchedCount() const { return searchedCount(); }
};

class WeighStep {
public:
    virtual ~WeighStep() = default;
    virtual const CellWeights& run(const LumaPyramid& luma, const FlowCells& flow,
                                   const TileWork& work) = 0;
    /// Lowers the weights of the last run() on the same frame where the still shows less of the
    /// video's finest detail than `match` leads to expect; see params::kFineRoom.
    virtual const CellWeights& confirm(const VideoFrame& frame, const StillPictures& still,
                                       const TileWork& work, const FineMatch& match) = 0;
};

/// Statistics of one frame.
struct TileSummary {
    std::array<int, kTileClasses> tiles{};  ///< per TileClass
    double meanConfidence = 0;              ///< [0, 1]
    double explained = 0;  ///< share of tiles that are flat or explained by a still, [0, 1]
    double changed = 0;    ///< share of tiles that were drawn, [0, 1]
    int second = 0;        ///< tiles that show parts of the second still
};

struct DetailOptions {
    SuperResMode mode = SuperResMode::Detail;
    bool cubic = true;          ///< Quality::cubic
    bool upscaledTiles = true;  ///< SkipOptions::upscaledTiles
    bool plainTiles = true;     ///< SkipOptions::plainTiles
    /// Filters for Quality::learned; null: no enlargement by filters.
    const FilterBank* filters = nullptr;
};

class DetailStep {
public:
    /// A still and its match.
    struct Matched {
        const StillPictures& still;
        const CellWeights& weights;
        /// A second still, shown where its weight is larger; may be null. Only in mode Detail with
        /// filters.
        const Matched* second = nullptr;
    };

    virtual ~DetailStep() = default;
    /// Draws the tiles of `work`; the others keep their pixels. `matched` null: only enlarges.
    virtual void draw(const VideoFrame& frame, const Matched* matched, const TileWork& work,
                      const DetailOptions& options) = 0;
    /// RGBA8, row 0 on top, alpha 255. Pixels drawn over it remain until draw() redraws their
    /// tiles.
    [[nodiscard]] virtual Field<std::uint32_t>& output() = 0;
    /// Summary of the last frame. May wait for the GPU.
    [[nodiscard]] virtual TileSummary summary() const = 0;
    /// Summary of a frame that is certainly finished: the last, or on a GPU the one before.
    [[nodiscard]] virtual TileSummary finishedSummary() const { return summary(); }
    /// Class of every tile in the last frame, row-major. May wait for the GPU.
    [[nodiscard]] virtual std::vector<TileClass> classes() const = 0;
};

using params::kShadowLift;

/// The virtual objects only, as the video camera sees them; possibly at fewer pixels than the
/// output.
struct LayerPicture {
    Field<std::uint32_t> colour;  ///< RGBA8, premultiplied by coverage
    Field<float> depth;           ///< z along the camera's axis [m]; 0: no object
    PixelRect bounds;             ///< covered pixels of the layer
};

class OcclusionStep {
public:
    virtual ~OcclusionStep() = default;
    /// Draws the virtual objects over the picture, except where the real scene is nearer. `real` is
    /// unknown outside `where` [video px].
    virtual void draw(const LayerPicture& layer, const InverseDepthField& real,
                      const PixelRect& where, const VideoFrame& frame,
                      Field<std::uint32_t>& picture) = 0;
    /// Visible share of each output pixel of the layer in the last draw(), within its bounds. May
    /// wait for the GPU.
    [[nodiscard]] virtual std::vector<float> visibility() const = 0;
};

}  // namespace mfar
