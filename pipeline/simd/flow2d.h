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

/// Dense flow between video and still in both directions, which does not need poses. CPU version of
/// the GLES engine's Flow2d, with the same pyramids.
///
/// Skips work whose result is not read. At the two finest pyramid levels, tiles that are not
/// matched are searched only where neighbours use their vectors; so are unchanged tiles, if only
/// changed tiles are drawn. Cells of the still are searched only where forward vectors end.
class Flow2d {
public:
    /// Throws std::invalid_argument if an option is out of range.
    Flow2d(Size video, const Flow2dOptions& options, std::shared_ptr<Workers> workers);

    /// Takes effect with the next run, but only for options that may change between frames, see
    /// changed() in flow_options.h. Throws std::invalid_argument if an option is out of range.
    void setOptions(const Flow2dOptions& options) { options_ = changed(options_, options); }

    /// Pyramids of the video's size, stored in `words` with the layout of luma_layout.h.
    struct Luma {
        const std::vector<LumaLevel>& video;
        const std::vector<LumaLevel>& still;
        std::span<const std::uint32_t> words;
    };
    /// Computes the flow in both directions; does nothing if no changed tile is matched.
    /// `usePrior`: the last frame's flow provides a candidate for every cell (not allowed after a
    /// new still).
    void run(const Luma& luma, const TileWork& work, bool usePrior);

    /// Computes the forward field by refining `forward`, one vector per cell with an error of a
    /// fraction of a pixel. `errors`: known two-way errors [px] (eq. 2 of the paper), in the first
    /// entry. Tiles with wrong vectors are searched in two dimensions, from coarse to fine.
    using Cells = std::span<const std::array<float, 4>>;
    void refine(const Luma& luma, const TileWork& work, Cells forward, Cells errors);

    /// Flow from video to still: one entry per cell of 4x4 pixels, row by row without gaps.
    [[nodiscard]] Rows<const FlowCell> forward() const { return rowsOf(forward_, videoCells_); }
    /// Flow from still to video, at pyramid level backwardLevel(); valid after run().
    [[nodiscard]] Rows<const FlowCell> backward() const { return rowsOf(backward_, stillCells_); }
    [[nodiscard]] int backwardLevel() const { return backwardLevel_; }
    /// True after refine(): errors() holds the two-way errors of the video's cells.
    [[nodiscard]] bool errorsGiven() const { return errorsGiven_; }
    [[nodiscard]] Rows<const ErrorCell> errors() const { return rowsOf(errors_, videoCells_); }

    /// A flag for each tile: true if the last refine() searched it.
    [[nodiscard]] const std::vector<bool>& searchedTiles() const { return searched_.tiles(); }
    [[nodiscard]] int searchedCount() const { return searched_.count(); }

private:
    /// Flow of one pyramid level in one direction. It has two areas, because propagation cannot
    /// work in place.
    struct Stage {
        FlowField areas[2];
        explicit Stage(Size cells) : areas{FlowField(cells), FlowField(cells)} {}
    };
    struct Direction {
        int finest;  // finest pyramid level that is searched in this direction
        std::vector<Stage> stages;
        AlignedRows<float> known;  // reliability of the finest level's cells, see CleanUpStep

        Direction(const std::vector<Size>& cells, int finestLevel);
    };
    /// One direction of the search, with its pictures and parameters.
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
    void chooseBackward();
    /// Returns the tiles in which a pyramid level is searched; null: all tiles.
    [[nodiscard]] const TileMask* maskOf(const Direction& direction, int level) const;
    [[nodiscard]] int roundsAt(const Way& way, int level) const;
    [[nodiscard]] SearchStep searchStep(const Way& way, int level, int area) const;
    void searchRow(const Way& way, int level, int row);
    void propagateRow(const Way& way, int level, int toArea, int row);
    /// Searches one pyramid level in one or both directions.
    void searchLevel(Ways ways, int level);
    void alignRow(const AlignStep& step, const TileWork& work, int row);
    void searchListed(const Way& way);
    void prepareCleanUp(Direction& direction);
    void cleanUpForward(const TileWork& work, bool keepsUnchanged);
    void cleanUpBackward();

    Flow2dOptions options_;
    std::shared_ptr<Workers> workers_;
    Direction forwards_, backwards_;
    int backwardLevel_;
    Size videoCells_, stillCells_;
    std::vector<FlowCell> forward_, backward_;
    std::vector<ErrorCell> errors_;
    bool errorsGiven_ = false;
    bool wantsAll_ = false;       // true: wanted_ contains every tile
    TileMask wanted_;             // tiles whose results are read
    TileMask fine_, next_;        // tiles searched at the finest pyramid level, and at the next one
    TileMask ends_, endsAround_;  // tiles where wanted forward vectors end; the same with a margin
    TileMask between_;            // temporary memory of widen()
    TileSearch searched_;
};

}  // namespace mfar::simd
