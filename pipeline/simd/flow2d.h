#pragma once

#include "base/workers.h"
#include "pipeline/engine/cells.h"
#include "pipeline/flow/flow_options.h"
#include "pipeline/flow/luma_layout.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/simd/flow_field.h"
#include "pipeline/simd/tile_search.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

/// Dense flow between video and still in both directions, without poses. CPU version of the GLES
/// engine's Flow2d, with the same pyramids.
///
/// Work whose result is not read is skipped. At the two finest pyramid levels, unmatched tiles are
/// searched only where neighbouring tiles read their vectors. If only changed tiles are drawn,
/// unchanged tiles are searched only there, too; run() does this only if `usePrior` is true. At the
/// finest level of the backward flow, cells of the still are searched only around the ends of flow
/// vectors from the video.
class Flow2d {
public:
    /// Throws std::invalid_argument if an option is out of range.
    Flow2d(Size video, const Flow2dOptions& options, std::shared_ptr<Workers> workers);

    /// Sets the options for the next calls of run() and refine(). Ignores `levels`, which cannot
    /// change between frames. Throws std::invalid_argument if an option is out of range.
    void setOptions(const Flow2dOptions& options) { options_ = changed(options_, options); }

    /// Luma pyramids of video and still, both of the video's size. `words` contains the pixels of
    /// all levels, as luma_layout.h defines.
    struct Luma {
        const std::vector<LumaLevel>& video;
        const std::vector<LumaLevel>& still;
        std::span<const std::uint32_t> words;
    };
    /// Computes the flow in both directions. Keeps the last flow if no changed tile is matched.
    /// `usePrior`: the last frame's flow from video to still is a candidate for every cell of the
    /// video; must be false after a new still.
    void run(const Luma& luma, const TileWork& work, bool usePrior);

    /// Computes the flow from video to still. The search starts from `forward`, the vectors of the
    /// epipolar search, whose error is a fraction of a pixel. Tiles in which these vectors do not
    /// match (see TileSearch) are searched in two dimensions, from coarse to fine. The first entry
    /// of each cell's `errors` is the two-way error of its `forward` vector [px], see eq. 2 of the
    /// paper (docs/paper.md). Unchanged tiles keep their flow and errors if `usePrior` is true and
    /// the last call was refine(); `usePrior` must be false after a new still. Keeps all if no
    /// changed tile is matched.
    using Cells = std::span<const std::array<float, 4>>;
    void refine(const Luma& luma, const TileWork& work, Cells forward, Cells errors, bool usePrior);

    /// Flow from video to still, one entry per cell of 4x4 pixels, row-major without gaps.
    [[nodiscard]] Rows<const FlowCell> forward() const { return rowsOf(forward_, videoCells_); }
    /// Flow from still to video, at pyramid level backwardLevel(); valid after run().
    [[nodiscard]] Rows<const FlowCell> backward() const { return rowsOf(backward_, stillCells_); }
    [[nodiscard]] int backwardLevel() const { return backwardLevel_; }
    /// True after refine(): errors() then contains the two-way errors of the video's cells. False
    /// after run(), which does not compute these errors. If no changed tile is matched, refine()
    /// and run() do not change this value.
    [[nodiscard]] bool errorsGiven() const { return errorsGiven_; }
    [[nodiscard]] Rows<const ErrorCell> errors() const { return rowsOf(errors_, videoCells_); }

    /// Returns a flag for each tile, row-major: true if the last call was refine() and it searched
    /// the tile in two dimensions. After run(), all flags are false.
    [[nodiscard]] const std::vector<bool>& searchedTiles() const { return searched_.tiles(); }
    [[nodiscard]] int searchedCount() const { return searched_.count(); }

private:
    /// Flow of one pyramid level in one direction. A round of propagation reads one of the `areas`
    /// and writes the other.
    struct Stage {
        FlowField areas[2];
        explicit Stage(Size cells) : areas{FlowField(cells), FlowField(cells)} {}
    };
    struct Direction {
        int finest;
        std::vector<Stage> stages;
        AlignedRows<float> known;  // reliability of the finest level's cells, see CleanUpStep

        Direction(const std::vector<Size>& cells, int finestLevel);
    };
    struct Way {
        Direction& direction;
        const std::vector<LumaLevel>& from;
        const std::vector<LumaLevel>& to;
        std::span<const std::uint32_t> words;
        bool usePrior;
        int finestPropagations;
    };
    using Ways = std::span<const Way* const>;
    template <class T>
    static Rows<const T> rowsOf(const std::vector<T>& cells, Size size) {
        return {cells.data(), size.width, size};
    }

    void chooseTiles(const TileWork& work, bool keepsUnchanged, int margin);
    void chooseBackward(const TileWork& work, bool ofAllMatched);
    /// Returns the tiles to search at a pyramid level; null: all tiles.
    [[nodiscard]] const TileMask* maskOf(const Direction& direction, int level) const;
    [[nodiscard]] int roundsAt(const Way& way, int level) const;
    [[nodiscard]] SearchStep searchStep(const Way& way, int level, int area) const;
    void searchRow(const Way& way, int level, int row);
    void propagateRow(const Way& way, int level, int toArea, int row);
    void searchLevel(Ways ways, int level);
    /// Returns true if the tile keeps the last frame's flow.
    [[nodiscard]] bool isKept(const TileWork& work, int column, int row) const {
        return work.at(column, row).matched != 0 && wanted_.at(column, row) == 0;
    }
    void alignRow(const AlignStep& step, const TileWork& work, int row);
    void searchListed(const Way& way);
    void prepareCleanUp(Direction& direction);
    void cleanUpForward(const TileWork& work, bool keepsUnchanged);
    void cleanUpBackward(bool keepsUnchanged);

    Flow2dOptions options_;
    std::shared_ptr<Workers> workers_;
    Direction forwards_, backwards_;
    int backwardLevel_;
    Size videoCells_, stillCells_;
    std::vector<FlowCell> forward_, backward_;
    std::vector<ErrorCell> errors_, errorsBefore_;
    bool errorsGiven_ = false;
    bool wantsAll_ = false;
    TileMask wanted_;       // tiles whose results are read
    TileMask fine_, next_;  // tiles searched at pyramid level 0 (the finest), and at level 1
    // ends_: tiles of the still in which flow vectors of wanted_ end. endsAround_: the same tiles
    // and a margin around them.
    TileMask ends_, endsAround_;
    TileMask between_;
    TileSearch searched_;
};

}  // namespace mfar::simd
