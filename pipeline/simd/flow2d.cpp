#include "pipeline/simd/flow2d.h"

#include "pipeline/engine/params/flow.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace mfar::simd {
namespace {

// The kMaskedLevels finest pyramid levels are searched only in the needed tiles. Coarser levels
// have few cells, so all of them are searched.
constexpr int kMaskedLevels = 2;

std::vector<Size> cellsOfLevels(Size video, int levels) {
    std::int32_t words = 0;
    std::vector<Size> out;
    for (const LumaLevel& level : lumaLayout(video, words))
        if (static_cast<int>(out.size()) < levels)
            out.push_back(cellsOf(Size{level.width, level.height}));
    return out;
}

PatchPicture pictureOf(const LumaLevel& level, std::span<const std::uint32_t> words) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(
        words.data() + static_cast<std::size_t>(level.offset) + kLumaMarginWords);
    return {first, 4 * std::ptrdiff_t{level.pitch}, level.width, level.height};
}

template <class Key, class Run>
void forTileRuns(int columns, int cellsPerTile, const Key& keyOf, const Run& run) {
    for (int first = 0; first < columns;) {
        const auto key = keyOf(first / cellsPerTile);
        int end = first + cellsPerTile;
        while (end < columns && keyOf(end / cellsPerTile) == key)
            end += cellsPerTile;
        run(first, std::min(end, columns), key);
        first = end;
    }
}

/// Copies flow vectors of the coarser pyramid level, converted to pixels of the finer level, to the
/// cells [first, end), which are not searched.
void enlargeCells(const FlowPlanes& coarse, const FlowPlanes& fine, int row, int first, int end) {
    for (int column = first; column < end; ++column) {
        const std::ptrdiff_t from = row / 2 * coarse.pitch + column / 2;
        const std::ptrdiff_t to = row * fine.pitch + column;
        fine.x[to] = 2 * coarse.x[from];
        fine.y[to] = 2 * coarse.y[from];
        fine.cost[to] = fine.texture[to] = 0;
    }
}

}  // namespace

Flow2d::Direction::Direction(const std::vector<Size>& cells, int finestLevel)
    : finest(std::min(finestLevel, static_cast<int>(cells.size()) - 1)),
      known(FlowField::withMargins(cells[static_cast<std::size_t>(finest)])) {
    for (const Size size : cells)
        stages.emplace_back(size);
}

Flow2d::Flow2d(Size video, const Flow2dOptions& options, std::shared_ptr<Workers> workers)
    : options_(validated(options)), workers_(std::move(workers)),
      forwards_(cellsOfLevels(video, options.levels), 0),
      backwards_(cellsOfLevels(video, options.levels), params::kBackwardFinest),
      backwardLevel_(backwards_.finest), videoCells_(cellsOf(video)),
      stillCells_(backwards_.stages[static_cast<std::size_t>(backwardLevel_)].areas[0].cells()),
      forward_(static_cast<std::size_t>(videoCells_.width) * videoCells_.height),
      backward_(static_cast<std::size_t>(stillCells_.width) * stillCells_.height),
      errors_(forward_.size()), errorsBefore_(errors_), wanted_(tilesOf(video)),
      fine_(wanted_.size), next_(wanted_.size), ends_(wanted_.size), endsAround_(wanted_.size),
      between_(wanted_.size), searched_(videoCells_, static_cast<int>(forwards_.stages.size())) {}

void Flow2d::chooseTiles(const TileWork& work, bool keepsUnchanged, int margin) {
    for (std::size_t i = 0; i < wanted_.flags.size(); ++i) {
        const TileWork::Tile tile = work.flags[i];
        const bool read = tile.matched != 0 && (tile.changed != 0 || !keepsUnchanged);
        wanted_.flags[i] = read ? 1 : 0;
    }
    wantsAll_ = std::ranges::find(wanted_.flags, 0) == wanted_.flags.end();
    widen(wanted_, margin, between_, fine_);
    // The search of a cell reads neighbouring cells of the next coarser pyramid level. So one more
    // tile on each side is needed there.
    widen(fine_, 1, between_, next_);
}

// Marks the tiles of the still in which the backward flow is needed. Each wanted forward vector
// needs the backward cells around its end, because the two-way error is interpolated between them.
// Clean-up and propagation read three more cells on each side. With `ofAllMatched`, the vectors of
// unchanged tiles need them, too, because the last frame had no backward flow.
void Flow2d::chooseBackward(const TileWork& work, bool ofAllMatched) {
    std::ranges::fill(ends_.flags, std::uint8_t{0});
    for (int y = 0; y < videoCells_.height; ++y)
        for (int x = 0; x < videoCells_.width; ++x) {
            const int column = x / kCellsPerTile, row = y / kCellsPerTile;
            const bool reads =
                ofAllMatched ? work.at(column, row).matched != 0 : wanted_.at(column, row) != 0;
            if (!reads) continue;
            const FlowCell& cell = forward_[static_cast<std::size_t>(y) * videoCells_.width + x];
            const auto tileAt = [](int at, float by, int tiles) {
                const float end = (static_cast<float>(kCell * at) + by) / kTileSize;
                return static_cast<int>(std::clamp(end, 0.0F, static_cast<float>(tiles - 1)));
            };
            ends_.at(tileAt(x, cell.x, ends_.size.width), tileAt(y, cell.y, ends_.size.height)) = 1;
        }
    constexpr int kMargin = 3;  // [tiles]; a tile has 2x2 cells of the backward field
    widen(ends_, kMargin, between_, endsAround_);
}

const TileMask* Flow2d::maskOf(const Direction& direction, int level) const {
    const int coarsest = static_cast<int>(direction.stages.size()) - 1;
    if (level >= std::min(kMaskedLevels, coarsest) || wantsAll_) return nullptr;
    if (&direction == &backwards_) return &endsAround_;
    return level == 0 ? &fine_ : &next_;
}

int Flow2d::roundsAt(const Way& way, int level) const {
    if (level + 1 == static_cast<int>(way.direction.stages.size()))
        return options_.coarsestPropagations;
    return level == way.direction.finest ? way.finestPropagations : 1;
}

SearchStep Flow2d::searchStep(const Way& way, int level, int area) const {
    const auto l = static_cast<std::size_t>(level);
    std::vector<Stage>& stages = way.direction.stages;
    SearchStep s;
    s.from = pictureOf(way.from[l], way.words);
    s.to = pictureOf(way.to[l], way.words);
    s.out = stages[l].areas[area].planes();
    if (l + 1 < stages.size()) s.coarser = stages[l + 1].areas[0].planes();
    s.radius = way.usePrior ? params::kTrackingRadius : options_.searchRadius;
    s.candidates = options_.candidates;
    s.steps = options_.steps;
    s.prior.scale = 1.0F / static_cast<float>(1 << level);
    s.prior.columnsPerCell =
        static_cast<float>(videoCells_.width) / static_cast<float>(s.out.columns);
    s.prior.rowsPerCell = static_cast<float>(videoCells_.height) / static_cast<float>(s.out.rows);
    if (way.usePrior) {
        s.prior.x = &forward_[0].x;
        s.prior.y = &forward_[0].y;
        s.prior.step = sizeof(FlowCell) / sizeof(float);
        s.prior.pitch = s.prior.step * videoCells_.width;
    }
    return s;
}

void Flow2d::searchRow(const Way& way, int level, int row) {
    const SearchStep step = searchStep(way, level, roundsAt(way, level) % 2);
    const TileMask* mask = maskOf(way.direction, level);
    if (mask == nullptr) {
        searchCells(step, row, 0, step.out.columns);
        return;
    }
    const int side = kCellsPerTile >> level;
    const FlowPlanes last = way.direction.stages[static_cast<std::size_t>(level)].areas[0].planes();
    forTileRuns(
        step.out.columns, side, [&](int tile) { return mask->at(tile, row / side); },
        [&](int first, int end, int isNeeded) {
            if (isNeeded != 0)
                searchCells(step, row, first, end);
            else
                enlargeCells(step.coarser, last, row, first, end);
        });
}

void Flow2d::propagateRow(const Way& way, int level, int toArea, int row) {
    const auto l = static_cast<std::size_t>(level);
    Stage& stage = way.direction.stages[l];
    const PropagateStep step{pictureOf(way.from[l], way.words), pictureOf(way.to[l], way.words),
                             stage.areas[toArea].planes(), stage.areas[1 - toArea].planes(),
                             params::kPropagateSteps};
    const TileMask* mask = maskOf(way.direction, level);
    const int side = std::max(kCellsPerTile >> level, 1);
    forTileRuns(
        step.out.columns, side,
        [&](int tile) { return mask == nullptr || mask->at(tile, row / side) != 0; },
        [&](int first, int end, bool isNeeded) {
            if (isNeeded) propagateCells(step, row, first, end);
        });
}

// The rounds of propagation alternate between a Stage's two areas. The first area is chosen so that
// the last round writes area 0.
void Flow2d::searchLevel(Ways ways, int level) {
    const int rows =
        ways[0]->direction.stages[static_cast<std::size_t>(level)].areas[0].cells().height;
    const int both = rows * static_cast<int>(ways.size());
    forRows(workers_.get(), 0, both, 1,
            [&](int y) { searchRow(*ways[static_cast<std::size_t>(y / rows)], level, y % rows); });
    int most = 0;
    for (const Way* way : ways)
        most = std::max(most, roundsAt(*way, level));
    for (int round = most; round > 0; --round)
        forRows(workers_.get(), 0, both, 1, [&](int y) {
            const Way& way = *ways[static_cast<std::size_t>(y / rows)];
            if (round <= roundsAt(way, level)) propagateRow(way, level, (round - 1) % 2, y % rows);
        });
}

void Flow2d::run(const Luma& luma, const TileWork& work, bool usePrior) {
    searched_.clear();
    if (work.matched == 0) return;
    const bool lacksBackward = std::exchange(errorsGiven_, false);
    const Way forward{forwards_,  luma.video, luma.still,
                      luma.words, usePrior,   options_.propagations};
    const Way backward{backwards_, luma.still, luma.video,
                       luma.words, false,      params::kBackwardPropagations};
    const Way* const ways[] = {&forward, &backward};
    const Ways both(ways), forwardAlone(ways, 1), backwardAlone(ways + 1, 1);
    // Vectors of unchanged tiles stay valid as long as the still does not change.
    const bool keepsUnchanged = usePrior && !work.drawsWhole();
    const int reach = kCleanUpRadius + options_.propagations;
    chooseTiles(work, keepsUnchanged, (reach + kCellsPerTile - 1) / kCellsPerTile);
    for (int level = static_cast<int>(forwards_.stages.size()) - 1; level >= 0; --level) {
        const bool together = level > backwardLevel_ || (wantsAll_ && level == backwardLevel_);
        searchLevel(together ? both : forwardAlone, level);
    }
    cleanUpForward(work, keepsUnchanged);
    if (!wantsAll_) {
        chooseBackward(work, keepsUnchanged && lacksBackward);
        searchLevel(backwardAlone, backwardLevel_);
    }
    cleanUpBackward(keepsUnchanged && !lacksBackward);
}

void Flow2d::alignRow(const AlignStep& step, const TileWork& work, int row) {
    const int tileRow = row / kCellsPerTile;
    forTileRuns(
        step.out.columns, kCellsPerTile,
        [&](int tile) {
            return work.at(tile, tileRow).matched != 0 && fine_.at(tile, tileRow) != 0;
        },
        [&](int first, int end, bool isMatched) {
            if (isMatched)
                alignCells(step, row, first, end);
            else
                keepSeedCells(step, row, first, end);
        });
}

void Flow2d::refine(const Luma& luma, const TileWork& work, Cells forward, Cells errors,
                    bool usePrior) {
    searched_.clear();
    if (work.matched == 0) return;
    const bool keepsUnchanged = usePrior && errorsGiven_ && !work.drawsWhole();
    errorsGiven_ = true;
    if (keepsUnchanged) std::ranges::copy(errors_, errorsBefore_.begin());
    // Width of the margin around the wanted tiles in which vectors are also needed [tiles]. The
    // clean-up reads neighbouring vectors, and TileSearch needs them to choose the searched tiles.
    constexpr int kMargin = 2;
    chooseTiles(work, keepsUnchanged, kMargin);
    const FlowPlanes field = forwards_.stages[0].areas[0].planes();
    const AlignStep step{pictureOf(luma.video[0], luma.words), pictureOf(luma.still[0], luma.words),
                         field, forward[0].data(), params::kAlignSteps};
    forRows(workers_.get(), 0, field.rows, 1, [&](int row) {
        alignRow(step, work, row);
        const std::size_t first = static_cast<std::size_t>(row) * videoCells_.width;
        for (std::size_t i = first; i < first + static_cast<std::size_t>(videoCells_.width); ++i)
            errors_[i].error = errors[i][0];
    });
    searched_.find(field, errors_, work.noise);
    if (searched_.count() > 0)
        searchListed({forwards_, luma.video, luma.still, luma.words, false, 0});
    cleanUpForward(work, keepsUnchanged);
    // Neighbours of wanted tiles were searched with the errors of this frame's vectors.
    if (!keepsUnchanged) return;
    for (std::size_t i = 0; i < errors_.size(); ++i) {
        const auto [row, column] = std::div(static_cast<int>(i), videoCells_.width);
        if (isKept(work, column / kCellsPerTile, row / kCellsPerTile))
            errors_[i] = errorsBefore_[i];
    }
}

// Searches the listed groups of cells from coarse to fine. There is no propagation, because not all
// neighbours of a listed group are listed. The vectors found on epipolar lines are candidates at
// every pyramid level. At the finest level, they are kept unless another vector fits clearly
// better.
void Flow2d::searchListed(const Way& way) {
    const FlowPlanes lines = forwards_.stages[0].areas[0].planes();
    for (int level = static_cast<int>(forwards_.stages.size()) - 1; level >= 0; --level) {
        ListedStep step{searchStep(way, level, 0), nullptr, 0};
        step.search.radius = std::min(params::kListedRadius, options_.searchRadius);
        step.search.prior.x = lines.x;
        step.search.prior.y = lines.y;
        step.search.prior.step = 1;
        step.search.prior.pitch = lines.pitch;
        if (level == 0) {
            step.errors = &errors_[0].error;
            step.errorPitch = std::ptrdiff_t{4} * videoCells_.width;
        }
        const std::span<const TileSearch::Group> groups = searched_.groups(level);
        forRows(workers_.get(), 0, static_cast<int>(groups.size()), 1, [&](int i) {
            const auto [x, y] = groups[static_cast<std::size_t>(i)];
            searchListedGroup(step, x, y);
        });
    }
}

void Flow2d::prepareCleanUp(Direction& direction) {
    const FlowPlanes field =
        direction.stages[static_cast<std::size_t>(direction.finest)].areas[0].planes();
    float* known = FlowField::first(direction.known);
    forRows(workers_.get(), 0, field.rows, 1,
            [&](int row) { prepareCleanUpRow(field, known, row); });
    const auto repeat = [&](float* plane) {
        const int room = field.columns + 2 * kCleanUpRadius;
        const auto copy = [&](int from, int to) {
            std::copy_n(plane + from * field.pitch - kCleanUpRadius, room,
                        plane + to * field.pitch - kCleanUpRadius);
        };
        for (int i = 1; i <= kCleanUpRadius; ++i) {
            copy(0, -i);
            copy(field.rows - 1, field.rows - 1 + i);
        }
    };
    repeat(field.x);
    repeat(field.y);
    repeat(known);
}

void Flow2d::cleanUpForward(const TileWork& work, bool keepsUnchanged) {
    prepareCleanUp(forwards_);
    const FlowPlanes field = forwards_.stages[0].areas[0].planes();
    const CleanUpStep step{field, FlowField::first(forwards_.known), &forward_[0].x,
                           options_.planeFits};
    enum class Does : std::uint8_t { CleansUp, Copies, Keeps };
    forRows(workers_.get(), 0, field.rows, 1, [&](int row) {
        forTileRuns(
            field.columns, kCellsPerTile,
            [&](int tile) {
                if (wanted_.at(tile, row / kCellsPerTile) != 0) return Does::CleansUp;
                const bool keeps = keepsUnchanged && isKept(work, tile, row / kCellsPerTile);
                return keeps ? Does::Keeps : Does::Copies;
            },
            [&](int first, int end, Does does) {
                if (does == Does::CleansUp) cleanUpCells(step, row, first, end);
                if (does == Does::Copies) copyCells(step, row, first, end);
            });
    });
}

// With `keepsUnchanged`, cells that were not searched keep their vectors, which the two-way errors
// of unchanged tiles need.
void Flow2d::cleanUpBackward(bool keepsUnchanged) {
    prepareCleanUp(backwards_);
    const FlowPlanes field =
        backwards_.stages[static_cast<std::size_t>(backwardLevel_)].areas[0].planes();
    const CleanUpStep step{field, FlowField::first(backwards_.known), &backward_[0].x,
                           options_.planeFits};
    const TileMask* mask = keepsUnchanged ? maskOf(backwards_, backwardLevel_) : nullptr;
    const int side = std::max(kCellsPerTile >> backwardLevel_, 1);
    forRows(workers_.get(), 0, field.rows, 1, [&](int row) {
        forTileRuns(
            field.columns, side,
            [&](int tile) { return mask == nullptr || mask->at(tile, row / side) != 0; },
            [&](int first, int end, bool isSearched) {
                if (isSearched) cleanUpCells(step, row, first, end);
            });
    });
}

}  // namespace mfar::simd
