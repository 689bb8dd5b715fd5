#include "pipeline/gles/flow2d.h"

#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <cstdint>

namespace mfar {
namespace {

constexpr int kGroup = 4;  // width and height of the shaders' workgroups [cells]
Size cellsOf(const LumaLevel& level) {
    return cellsOf(Size{level.width, level.height});
}

std::vector<LumaLevel> levelsOf(Size video, const Flow2dOptions& options) {
    std::int32_t words = 0;
    std::vector<LumaLevel> levels = lumaLayout(video, words);
    levels.resize(std::min(levels.size(), static_cast<std::size_t>(options.levels)));
    return levels;
}

}  // namespace

Flow2d::Flow2d(Size video, const Flow2dOptions& options)
    : options_(validated(options)),
      searched_(cellsOf(video), static_cast<int>(levelsOf(video, options).size())),
      search_("flow_search.comp"), searchListed_("flow_search.comp", "#define LISTED\n"),
      propagate_("flow_propagate.comp"), align_("flow_align.comp"), filter_("flow_filter.comp") {
    int next = 0;
    const auto take = [&](Size cells) {
        const int at = next;
        next += cells.width * cells.height;
        return at;
    };
    for (std::vector<Stage>* stages : {&forwardStages_, &backwardStages_}) {
        for (const LumaLevel& level : levelsOf(video, options)) {
            const Size cells = cellsOf(level);
            stages->push_back(
                {cells,
                 {take(cells), take(cells)},
                 {gpu::groupsFor(cells.width, kGroup), gpu::groupsFor(cells.height, kGroup), 1}});
        }
    }
    forward_ = {take(forwardStages_[0].cells), forwardStages_[0].cells};
    const int finest =
        std::min(params::kBackwardFinest, static_cast<int>(backwardStages_.size()) - 1);
    // backward_ also stores the two-way errors of refine(), one for each cell of the video.
    backward_ = {take(forward_.cells), backwardStages_[finest].cells, finest};
    seed_ = take(forward_.cells);
    cells_ = gpu::Buffer(static_cast<std::size_t>(next) * 4 * sizeof(float));
}

void Flow2d::run(const LumaOnGpu& luma, const TileBuffer& tiles, bool usePrior) {
    searched_.clear();
    // If nothing is matched, the memory of backward_ keeps what it contains: a flow or errors.
    if (tiles.work().matched == 0) return;
    errorsGiven_ = false;
    run({luma.video, luma.still, forwardStages_, 0, options_.propagations, usePrior}, luma);
    run({luma.still, luma.video, backwardStages_, backward_.level, params::kBackwardPropagations,
         false},
        luma);
    filter(forwardStages_[0], forward_, tiles);
    filter(backwardStages_[backward_.level], backward_, tiles);
}

void Flow2d::refine(const LumaOnGpu& luma, const TileBuffer& tiles, Cells forward, Cells errors) {
    if (tiles.work().matched == 0) {
        searched_.clear();
        return;
    }
    errorsGiven_ = true;
    cells_.write(forward, 16UL * seed_);
    cells_.write(errors, 16UL * backward_.offset);
    const Stage& stage = forwardStages_[0];
    align(seed_, luma, tiles);
    searched_.find({cells_, stage.area[0], backward_.offset}, tiles);
    searchListed(luma);
    filter(stage, forward_, tiles);
}

// Searches the listed groups of cells from coarse to fine. There is no propagation, because the
// neighbours of a listed group need not be listed. At every pyramid level, the flow along epipolar
// lines is one of the candidates. At the finest level, a vector that is more than params::kOnLine
// away from this flow replaces it only if it fits clearly better (params::kClearlyLess).
void Flow2d::searchListed(const LumaOnGpu& luma) {
    const Direction way{luma.video, luma.still, forwardStages_, 0, 0, false};
    for (int level = static_cast<int>(way.stages.size()) - 1; level >= 0; --level) {
        params::SearchFlow p =
            searchParams(way, level, 0, std::min(params::kListedRadius, options_.searchRadius),
                         forwardStages_[0].area[0]);
        p.firstGroup = searched_.first(level);
        p.errors = level == 0 ? backward_.offset : -1;
        searchListed_.runIndirect(p,
                                  {gpu::storage(0, luma.words), gpu::storage(1, cells_),
                                   gpu::storage(2, searched_.lists())},
                                  searched_.commands(), 16UL * level);
    }
}

void Flow2d::run(const Direction& way, const LumaOnGpu& luma) {
    const int coarsest = static_cast<int>(way.stages.size()) - 1;
    for (int level = coarsest; level >= way.finest; --level) {
        int rounds = 1;
        if (level == way.finest) rounds = way.finestPropagations;
        if (level == coarsest) rounds = options_.coarsestPropagations;
        // search() and each round of propagate() write the two areas of the stage alternately.
        // search() begins with the area that makes the last round write area 0.
        search(way, level, rounds % 2, luma);
        for (int round = rounds; round > 0; --round)
            propagate(way, level, (round - 1) % 2, luma);
    }
}

void Flow2d::search(const Direction& way, int level, int area, const LumaOnGpu& luma) {
    const params::SearchFlow p = searchParams(
        way, level, area, way.usePrior ? params::kTrackingRadius : options_.searchRadius,
        way.usePrior ? forward_.offset : -1);
    search_.run(p, {gpu::storage(0, luma.words), gpu::storage(1, cells_)},
                way.stages[level].groups);
}

// `prior`: index in cells() of a field whose vectors are further candidates for the search. The
// field belongs to the finest pyramid level. -1: there is no such field.
params::SearchFlow Flow2d::searchParams(const Direction& way, int level, int area, int radius,
                                        int prior) const {
    const Stage& stage = way.stages[level];
    const bool coarsest = level + 1 == static_cast<int>(way.stages.size());
    const int side = 2 * radius + 1;
    const Size coarser = coarsest ? Size{} : way.stages[level + 1].cells;
    const Size finest = forward_.cells;
    return {.from = way.from[level],
            .to = way.to[level],
            .columns = stage.cells.width,
            .rows = stage.cells.height,
            .coarserColumns = coarser.width,
            .coarserRows = coarser.height,
            .target = stage.area[area],
            .coarser = coarsest ? -1 : way.stages[level + 1].area[0],
            .lastFrame = prior,
            .lastFrameColumns = finest.width,
            .radius = radius,
            .candidates = (prior >= 0 ? 1 : 0) + (coarsest ? side * side : options_.candidates),
            .steps = options_.steps,
            .perLastFrame = 1.0F / static_cast<float>(1 << level),
            .lastFrameX = static_cast<float>(finest.width) / static_cast<float>(stage.cells.width),
            .lastFrameY =
                static_cast<float>(finest.height) / static_cast<float>(stage.cells.height),
            .firstGroup = 0,
            .errors = -1};
}

void Flow2d::propagate(const Direction& way, int level, int toArea, const LumaOnGpu& luma) {
    const Stage& stage = way.stages[level];
    propagate_.run({.from = way.from[level],
                    .to = way.to[level],
                    .columns = stage.cells.width,
                    .rows = stage.cells.height,
                    .target = stage.area[toArea],
                    .source = stage.area[1 - toArea],
                    .steps = params::kPropagateSteps},
                   {gpu::storage(0, luma.words), gpu::storage(1, cells_)}, stage.groups);
}

void Flow2d::align(int in, const LumaOnGpu& luma, const TileBuffer& tiles) {
    const Stage& stage = forwardStages_[0];
    align_.run(
        {.from = luma.video[0],
         .to = luma.still[0],
         .columns = stage.cells.width,
         .rows = stage.cells.height,
         .target = stage.area[0],
         .source = in,
         .steps = params::kAlignSteps},
        {gpu::storage(0, luma.words), gpu::storage(1, cells_), gpu::storage(2, tiles.buffer())},
        stage.groups);
}

void Flow2d::filter(const Stage& stage, const Field& out, const TileBuffer& tiles) {
    // Only at the finest pyramid level does a workgroup process exactly one tile.
    filter_.run({.columns = stage.cells.width,
                 .rows = stage.cells.height,
                 .target = out.offset,
                 .source = stage.area[0],
                 .planeFits = options_.planeFits,
                 .byTile = out.level == 0 ? 1 : 0},
                {gpu::storage(1, cells_), gpu::storage(2, tiles.buffer())}, stage.groups);
}

}  // namespace mfar
