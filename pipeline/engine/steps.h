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

// The steps of a frame that exist on both engines, GLES shaders and host SIMD. A step's constructor
// allocates all that it needs; what run() returns is valid until its next run().

namespace mfar {

class FilterBank;
struct FineMatch;
class PlaneImporter;

/// A frame of the video sensor: as the camera delivered it, and its colours as planes.
struct VideoFrame {
    const ImageView& view;
    const RgbPlanes& planes;
    std::uint64_t number;  ///< a new one for each frame
};

/// What is known of the newest still.
struct StillPictures {
    std::uint64_t number = 0;  ///< a new one for each still
    StereoRig rig;             ///< with the still camera as the fields below have it
    Field<std::uint8_t> luma;  ///< of the whole still
    // Luma whose finest detail is raised, see params::kLinearLoss: as the engine reads it that made
    // it. The other field is empty.
    Field<std::uint8_t> raised;    ///< from the GLES engine
    Field<std::uint16_t> pairs;    ///< from the SIMD engine; with the pixel below in the high byte
    Field<std::uint32_t> picture;  ///< RGBA8; for SuperResMode::Blend alone
};

/// Luma pyramids of the video and of the still at the video's geometry: what flow compares.
struct LumaPyramid {
    std::vector<LumaLevel> video, still;
    Field<std::uint32_t> words;  ///< one row
};

/// Flow between video and still. One row: first the forward field, then as many entries for the
/// backward field or, as ErrorCell, for the two-way errors that were given.
struct FlowCells {
    Field<FlowCell> cells;
    Size forward, backward;  ///< columns, rows
    int backwardLevel = 0;   ///< of the pyramid
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
    /// Prepares a sound still of the still camera's size.
    virtual const StillPictures& run(const ImageView& still, SuperResMode mode) = 0;
    /// Adds what another mode needs of the same still.
    virtual void setMode(SuperResMode mode) = 0;
};

class PyramidStep {
public:
    virtual ~PyramidStep() = default;
    /// Does nothing where the frame matches no tile.
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
    /// Refines vectors that are right but for a fraction of a pixel, one per cell; `errors`: their
    /// two-way errors [px] in the first entry. Tiles whose vectors turn out wrong are searched.
    virtual const FlowCells& refine(const LumaPyramid& luma, const TileWork& work, Cells vectors,
                                    Cells errors) = 0;
    /// Tiles that the last refine() searched, row-major. May wait for the GPU.
    [[nodiscard]] virtual std::vector<bool> searchedTiles() const = 0;
    [[nodiscard]] virtual int searchedCount() const = 0;
    /// Their number in a frame that is surely finished: the last, or on a GPU the one before.
    [[nodiscard]] virtual int finishedSearchedCount() const { return searchedCount(); }
};

class WeighStep {
public:
    virtual ~WeighStep() = default;
    virtual const CellWeights& run(const LumaPyramid& luma, const FlowCells& flow,
                                   const TileWork& work) = 0;
    /// Lowers the weights of the last run() on the same frame where the still does not show the
    /// video's finest detail as `match` lets expect; see params::kFineRoom.
    virtual const CellWeights& confirm(const VideoFrame& frame, const StillPictures& still,
                                       const TileWork& work, const FineMatch& match) = 0;
};

/// Counts of one frame.
struct TileSummary {
    std::array<int, kTileClasses> tiles{};  ///< per TileClass
    double meanConfidence = 0;              ///< [0, 1]
    double explained = 0;  ///< share of tiles that are flat or that a still accounts for, [0, 1]
    double changed = 0;    ///< share of tiles that were drawn, [0, 1]
    int second = 0;        ///< tiles that show some of the second still
};

struct DetailOptions {
    SuperResMode mode = SuperResMode::Detail;
    bool cubic = true;          ///< Quality::cubic
    bool upscaledTiles = true;  ///< SkipOptions::upscaledTiles
    bool plainTiles = true;     ///< SkipOptions::plainTiles
    /// Where Quality::learned; null: not enlarged by filters.
    const FilterBank* filters = nullptr;
};

class DetailStep {
public:
    /// A still and how it matches.
    struct Matched {
        const StillPictures& still;
        const CellWeights& weights;
        /// A second still, seen where it counts for more; null: none. In mode Detail with filters
        /// alone.
        const Matched* second = nullptr;
    };

    virtual ~DetailStep() = default;
    /// Draws the tiles that `work` asks for; the others keep their pixels. Null: only enlarges.
    virtual void draw(const VideoFrame& frame, const Matched* matched, const TileWork& work,
                      const DetailOptions& options) = 0;
    /// RGBA8, row 0 on top, alpha 255. What is drawn over it lasts until the next draw() of its
    /// tiles.
    [[nodiscard]] virtual Field<std::uint32_t>& output() = 0;
    /// Of the last frame. May wait for the GPU.
    [[nodiscard]] virtual TileSummary summary() const = 0;
    /// Of a frame that is surely finished: the last, or on a GPU the one before.
    [[nodiscard]] virtual TileSummary finishedSummary() const { return summary(); }
    /// Class of every tile in the last frame, row-major. May wait for the GPU.
    [[nodiscard]] virtual std::vector<TileClass> classes() const = 0;
};

using params::kShadowLift;

/// Virtual objects alone, as the video camera sees them; it may have fewer pixels than the output.
struct LayerPicture {
    Field<std::uint32_t> colour;  ///< RGBA8, premultiplied by coverage
    Field<float> depth;           ///< z [m] along the camera's axis; 0: nothing
    PixelRect bounds;             ///< covered pixels of the layer
};

class OcclusionStep {
public:
    virtual ~OcclusionStep() = default;
    /// Lays the virtual objects over the picture, behind what is nearer there. `real` is unknown
    /// outside of `where` [video px].
    virtual void draw(const LayerPicture& layer, const InverseDepthField& real,
                      const PixelRect& where, const VideoFrame& frame,
                      Field<std::uint32_t>& picture) = 0;
    /// Share of each output pixel of the layer that the last draw() showed, within its bounds. May
    /// wait for the GPU.
    [[nodiscard]] virtual std::vector<float> visibility() const = 0;
};

}  // namespace mfar
