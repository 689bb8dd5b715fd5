#include "pipeline/simd/flow_choice.h"

#include "pipeline/engine/params/flow.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace mfar::simd {
namespace {

// Rows of cells whose pairs are compared together, so that few lanes of vectors are unused.
constexpr int kRowsTogether = 4;
constexpr int kNeighbours = 8;

float noiseOf(const TileWork& work) {
    const auto deviation = static_cast<float>(work.noise);
    return kCell * kCell * (deviation * deviation + params::kChoiceVariance);
}

}  // namespace

FlowChoice::Pairs::Pairs(int most) {
    constexpr int kLongestVector = 16;
    const Size size{most + kLongestVector, 1};
    for (AlignedRows<float>* values : {&row, &column, &flowX, &flowY, &error})
        *values = AlignedRows<float>(size);
    video = AlignedRows<std::int16_t>({kCell * size.width, kCell});
}

void FlowChoice::Pairs::add(int ofRow, int ofColumn, float x, float y) {
    row[0][count] = static_cast<float>(ofRow);
    column[0][count] = static_cast<float>(ofColumn);
    flowX[0][count] = x;
    flowY[0][count] = y;
    ++count;
}

const float* FlowChoice::Pairs::compare(const LookUpParams& lookUp, const StillPairs& still,
                                        float light) {
    compareFlowPairs(
        lookUp, still,
        {row[0], column[0], flowX[0], flowY[0], {video[0], video[1], video[2], video[3]}, light},
        count, error[0]);
    return error[0];
}

FlowChoice::Scratch::Scratch(const ComparedCells& cells)
    : luma(cells.makeLuma()), neighbours({wholeVectors(cells.cells).width, 1}),
      own(kRowsTogether * cells.cells.width),
      others(kNeighbours * kRowsTogether * cells.cells.width) {
    choosers.reserve(static_cast<std::size_t>(kRowsTogether) * cells.cells.width);
}

FlowChoice::FlowChoice(const StereoRig& stillRig, std::shared_ptr<Workers> workers,
                       ComparedCells& cells)
    : lookUp_(stillRig), workers_(std::move(workers)), cells_(cells),
      none_({cells_.cells.width, 1}),
      scratch_(workers_->count(), [this] { return Scratch(cells_); }) {}

void FlowChoice::run(const Frame& frame) {
    const int height = cells_.cells.height;
    workers_->forRange(height, kRowsTogether, [&](int first, int last) {
        scratch_.with([&](Scratch& scratch) {
            for (int row = first; row < last; row += kRowsTogether)
                choose(frame, scratch, row, std::min(row + kRowsTogether, last));
        });
    });
}

void FlowChoice::choose(const Frame& frame, Scratch& scratch, int first, int last) {
    scratch.choosers.clear();
    scratch.own.count = scratch.others.count = 0;
    for (int row = first; row < last; ++row)
        listOwn(frame, scratch, row);
    const float* own = scratch.own.compare(lookUp_, frame.still, frame.light);
    // With a smaller error, no neighbour is clearly better, not even with an error of 0.
    const float least = (1 / params::kClearlyBetter - 1) * noiseOf(frame.work);
    std::erase_if(scratch.choosers, [&](const Chooser& cell) { return !(own[cell.own] > least); });
    listOthers(scratch);
    takeBest(frame, scratch);
}

void FlowChoice::listOwn(const Frame& frame, Scratch& scratch, int row) {
    RowsAround compared = cells_.compared.around(row);
    if (row == 0) compared.above = none_[0];
    if (row == cells_.cells.height - 1) compared.below = none_[0];
    const std::int32_t* neighbours = scratch.neighbours[0];
    findFlowSteps({cells_.flowX.around(row), cells_.flowY.around(row), compared},
                  cells_.cells.width, scratch.neighbours[0]);
    const int before = scratch.own.count;
    for (int x = 0; x < cells_.cells.width; ++x) {
        if (neighbours[x] == 0) continue;
        scratch.choosers.push_back({row, x, scratch.own.count, neighbours[x]});
        scratch.own.add(row, x, cells_.flowX[row][x], cells_.flowY[row][x]);
    }
    if (scratch.own.count == before) return;
    const Chooser* cells = scratch.choosers.data();
    cells_.takeLuma(frame.video, row, cells[before].column, cells[scratch.own.count - 1].column + 1,
                    scratch.luma);
    for (int k = 0; k < kCell; ++k)
        for (int i = before; i < scratch.own.count; ++i)
            std::copy_n(scratch.luma[k] + kCell * cells[i].column, kCell,
                        scratch.own.video[k] + kCell * i);
}

void FlowChoice::listOthers(Scratch& scratch) {
    Pairs &own = scratch.own, &to = scratch.others;
    for (const Chooser& cell : scratch.choosers)
        for (int bit = 0; bit < 9; ++bit) {
            if ((cell.neighbours >> bit & 1) == 0) continue;
            for (int k = 0; k < kCell; ++k)
                std::copy_n(own.video[k] + kCell * cell.own, kCell, to.video[k] + kCell * to.count);
            const int x = cell.column + bit % 3 - 1, y = cell.row + bit / 3 - 1;
            to.add(cell.row, cell.column, cells_.flowX[y][x], cells_.flowY[y][x]);
        }
}

void FlowChoice::takeBest(const Frame& frame, Scratch& scratch) const {
    Pairs& others = scratch.others;
    const float* error = others.compare(lookUp_, frame.still, frame.light);
    const float* own = scratch.own.error[0];
    const float noise = noiseOf(frame.work);
    int next = 0;
    for (const Chooser& cell : scratch.choosers) {
        int best = -1;
        float least = std::numeric_limits<float>::infinity();
        for (const int end = next + std::popcount(static_cast<unsigned>(cell.neighbours));
             next < end; ++next)
            if (error[next] < least) {
                best = next;
                least = error[next];
            }
        // If one of the errors is NaN, the comparison is false.
        if (!(least + noise < params::kClearlyBetter * (own[cell.own] + noise))) continue;
        FlowCell& to =
            frame.flow[static_cast<std::size_t>(cell.row) * cells_.cells.width + cell.column];
        to.x = others.flowX[0][best];
        to.y = others.flowY[0][best];
    }
}

}  // namespace mfar::simd
