#include "pipeline/gles/flow2d.h"

#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <cstdint>

namespace mfar {
namespace {

constexpr int kGroup = 4;  // cells a workgroup and axis, as in the shaders
// With the last frame's field among the candidates only what moved on its own needs a search.
constexpr int kTrackingRadius = 3;
// Of tiles off their epipolar lines: 5 px are 80 px of the frame; what moved farther since the
// still is not worth four times the search.
constexpr int kListedRadius = 5;
constexpr int kPropagateSteps = 2;
// From a vector that is right but for a fraction of a pixel; four gain nothing.
constexpr int kAlignSteps = 2;
// The backward field only confirms: a tenth of a coarser level's pixel is a tenth of eq. 2's alpha.
constexpr int kBackwardFinest = 1;
constexpr int kBackwardPropagations = 1;

void put(std::int32_t (&out)[4], std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    out[0] = a;
    out[1] = b;
    out[2] = c;
    out[3] = d;
}

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
    const int finest = std::min(kBackwardFinest, static_cast<int>(backwardStages_.size()) - 1);
    // Room for refine()'s errors, one a cell of the video.
    backward_ = {take(forward_.cells), backwardStages_[finest].cells, finest};
    seed_ = take(forward_.cells);
    patches_ = gpu::Buffer(static_cast<std::size_t>(next) * 4 * sizeof(float));
}

void Flow2d::run(const LumaOnGpu& luma, const TileBuffer& tiles, bool usePrior) {
    errorsGiven_ = false;
    searched_.clear();
    if (tiles.work().matched == 0) return;
    run({luma.video, luma.still, forwardStages_, 0, options_.propagations, usePrior}, luma);
    run({luma.still, luma.video, backwardStages_, backward_.level, kBackwardPropagations, false},
        luma);
    filter(forwardStages_[0], forward_, tiles);
    filter(backwardStages_[backward_.level], backward_, tiles);
}

void Flow2d::refine(const LumaOnGpu& luma, const TileBuffer& tiles, Cells forward, Cells errors) {
    errorsGiven_ = true;
    patches_.write(forward, 16UL * seed_);
    patches_.write(errors, 16UL * backward_.offset);
    if (tiles.work().matched == 0) {
        searched_.clear();
        return;
    }
    const Stage& stage = forwardStages_[0];
    align(seed_, luma, tiles);
    searched_.find({patches_, stage.area[0], backward_.offset}, tiles);
    searchListed(luma);
    filter(stage, forward_, tiles);
}

// No propagation: a listed group's neighbours need not be listed. What the lines found is a
// candidate at every level, and at the finest it stays where nothing fits better.
void Flow2d::searchListed(const LumaOnGpu& luma) {
    const Direction way{luma.video, luma.still, forwardStages_, 0, 0, false};
    for (int level = static_cast<int>(way.stages.size()) - 1; level >= 0; --level) {
        SearchParams p = searchParams(way, level, 0, std::min(kListedRadius, options_.searchRadius),
                                      forwardStages_[0].area[0]);
        put(p.listed, searched_.first(level), level == 0 ? backward_.offset : -1, 0, 0);
        searchListed_.runIndirect(p,
                                  {gpu::storage(0, luma.words), gpu::storage(1, patches_),
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
        search(way, level, rounds % 2, luma);  // so that the last round ends in area 0
        for (int round = rounds; round > 0; --round)
            propagate(way, level, (round - 1) % 2, luma);
    }
}

void Flow2d::search(const Direction& way, int level, int area, const LumaOnGpu& luma) {
    const SearchParams p =
        searchParams(way, level, area, way.usePrior ? kTrackingRadius : options_.searchRadius,
                     way.usePrior ? forward_.offset : -1);
    search_.run(p, {gpu::storage(0, luma.words), gpu::storage(1, patches_)},
                way.stages[level].groups);
}

// `prior`: first vec4 of a field of the finest level whose vectors are candidates, or -1.
Flow2d::SearchParams Flow2d::searchParams(const Direction& way, int level, int area, int radius,
                                          int prior) const {
    const Stage& stage = way.stages[level];
    const bool coarsest = level + 1 == static_cast<int>(way.stages.size());
    const int side = 2 * radius + 1;
    SearchParams p{};
    p.from = way.from[level];
    p.to = way.to[level];
    const Size coarser = coarsest ? Size{} : way.stages[level + 1].cells;
    put(p.cells, stage.cells.width, stage.cells.height, coarser.width, coarser.height);
    put(p.offsets, stage.area[area], coarsest ? -1 : way.stages[level + 1].area[0], prior, 0);
    put(p.search, radius, (prior >= 0 ? 1 : 0) + (coarsest ? side * side : options_.candidates),
        options_.steps, forward_.cells.width);
    p.prior[0] = 1.0F / static_cast<float>(1 << level);
    p.prior[1] = static_cast<float>(forward_.cells.width) / static_cast<float>(stage.cells.width);
    p.prior[2] = static_cast<float>(forward_.cells.height) / static_cast<float>(stage.cells.height);
    return p;
}

Flow2d::LevelParams Flow2d::levelParams(const LumaLevel& from, const LumaLevel& to, Size cells,
                                        int out, int in, int steps) {
    LevelParams p{};
    p.from = from;
    p.to = to;
    put(p.cells, cells.width, cells.height, 0, 0);
    put(p.offsets, out, in, 0, 0);
    p.search[0] = steps;
    return p;
}

void Flow2d::propagate(const Direction& way, int level, int toArea, const LumaOnGpu& luma) {
    const Stage& stage = way.stages[level];
    const LevelParams p = levelParams(way.from[level], way.to[level], stage.cells,
                                      stage.area[toArea], stage.area[1 - toArea], kPropagateSteps);
    propagate_.run(p, {gpu::storage(0, luma.words), gpu::storage(1, patches_)}, stage.groups);
}

void Flow2d::align(int in, const LumaOnGpu& luma, const TileBuffer& tiles) {
    const Stage& stage = forwardStages_[0];
    const LevelParams p =
        levelParams(luma.video[0], luma.still[0], stage.cells, stage.area[0], in, kAlignSteps);
    align_.run(
        p,
        {gpu::storage(0, luma.words), gpu::storage(1, patches_), gpu::storage(2, tiles.buffer())},
        stage.groups);
}

void Flow2d::filter(const Stage& stage, const Field& out, const TileBuffer& tiles) {
    FilterParams p{};
    // The cells of a coarser level are not those of a tile.
    put(p.cells, stage.cells.width, stage.cells.height, options_.planeFits, out.level == 0 ? 1 : 0);
    put(p.offsets, out.offset, stage.area[0], 0, 0);
    filter_.run(p, {gpu::storage(1, patches_), gpu::storage(2, tiles.buffer())}, stage.groups);
}

}  // namespace mfar
