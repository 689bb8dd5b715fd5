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

/// Dense flow between video and still in both directions, without knowledge of the pose:
/// mfar::Flow2d on the CPU, on the same pyramids.
///
/// Skips work whose result is not read. At the two finest levels, tiles that are not matched (and
/// unchanged tiles, if only changed tiles are drawn) are searched only where neighbours use their
/// vectors. Cells of the still are searched only where vectors of the video end.
class Flow2d {
public:
    /// Throws std::invalid_argument for options out of range.
    Flow2d(Size video, const Flow2dOptions& options, std::shared_ptr<Workers> workers);

    /// See changed() in flow_options.h; takes effect with the next run. Throws
    /// std::invalid_argument for options out of range.
    void setOptions(const Flow2dOptions& options) { options_ = changed(options_, options); }

    /// Pyramids of the video's size, laid out by luma_layout.h in `words`.
    struct Luma {
        const std::vector<LumaLevel>& video;
        const std::vector<LumaLevel>& still;
        std::span<const std::uint32_t> words;
    };
    /// Computes both fields, unless no changed tile is matched. `usePrior`: the last frame's field
    /// is a candidate everywhere (not valid after a new still).
    void run(const Luma& luma, const TileWork& work, bool usePrior);

    /// Computes the forward field from one vector per cell that is correct within a fraction of a
    /// pixel. `errors`: known two-way errors of eq. 2, in x [px]. Tiles with wrong vectors are
    /// searched in 2-D from coarse to fine.
    using Cells = std::span<const std::array<float, 4>>;
    void refine(const Luma& luma, const TileWork& work, Cells forward, Cells errors);

    /// Cells of 4x4 pixels, row by row without gaps. Video -> still.
    [[nodiscard]] Rows<const FlowCell> forward() const { return rowsOf(forward_, videoCells_); }
    /// Still -> video, at level backwardLevel(); valid after run().
    [[nodiscard]] Rows<const FlowCell> backward() const { return rowsOf(backward_, stillCells_); }
    [[nodiscard]] int backwardLevel() const { return backwardLevel_; }
    /// Whether errors() holds the two-way errors of the video's cells: true after refine().
    [[nodiscard]] bool errorsGiven() const { return errorsGiven_; }
    [[nodiscard]] Rows<const ErrorCell> errors() const { return rowsOf(errors_, videoCells_); }

    /// The tiles that the last refine() searched.
    [[nodiscard]] const std::vector<bool>& searchedTiles() const { return searched_.tiles(); }
    [[nodiscard]] int searchedCount() const { return searched_.count(); }

private:
    /// One level of one direction: two areas, because propagation cannot work in place.
    struct Stage {
        FlowField areas[2];
        explicit Stage(Size cells) : areas{FlowField(cells), FlowField(cells)} {}
    };
    struct Direction {
        int finest;  // level
        std::vector<Stage> stages;
        AlignedRows<float> known;  // for the finest level's cells

        Direction(const std::vector<Size>& cells, int finestLevel);
    };
    /// One direction of the search through the levels: pictures, and parameters.
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
    /// The tiles in which a level is searched; null: all.
    [[nodiscard]] const TileMask* maskOf(const Direction& direction, int level) const;
    [[nodiscard]] int roundsAt(const Way& way, int level) const;
    [[nodiscard]] SearchStep searchStep(const Way& way, int level, int area) const;
    void searchRow(const Way& way, int level, int row);
    void propagateRow(const Way& way, int level, int toArea, int row);
    /// Searches one level in one or both directions.
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
    bool wantsAll_ = false;       // every tile is wanted
    TileMask wanted_;             // tiles whose results are read
    TileMask fine_, next_;        // searched at the finest level, and at the next
    TileMask ends_, endsAround_;  // where vectors end, and the tiles searched for those
    TileMask between_;            // scratch for widen()
    TileSearch searched_;
};

}  // namespace mfar::simd
