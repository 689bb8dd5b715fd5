#include "pipeline/simd/fine_check.h"

#include "pipeline/engine/params/weigh.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/enlarge_rows.h"

#include <algorithm>
#include <array>
#include <utility>

namespace mfar::simd {
namespace {

using params::kFineStep;
static_assert(kCellsPerTile % kFineStep == 0);
constexpr int kBlock = 2;
constexpr int kFirst = (kCell - 2) / 2;  // first of the two pixel rows of a cell that are compared
constexpr int kRoom = 64;                // number of pixels after a row that vectors can access

}  // namespace

FineCheck::Scratch::Scratch(const FineCheck& check)
    : lookUps(check.cells_, kSamples * check.video_.width),
      video({check.video_.width + kRoom, kBlock}),
      still({kSamples * (check.video_.width + kRoom), kSamples * kBlock}) {
    cells.reserve(static_cast<std::size_t>(check.cells_.width));
}

FineCheck::FineCheck(const StereoRig& stillRig, std::shared_ptr<Workers> workers)
    : video_(stillRig.video.size), cells_(cellsOf(video_)),
      sampled_{cells_.width, divideUp(cells_.height, kFineStep)}, workers_(std::move(workers)),
      taps_(stillRig, {kSamples * video_.width, kSamples * video_.height}), ofVideo_(sampled_),
      ofBoth_(sampled_), ofStill_(sampled_), shares_(wholeVectors(cells_)),
      scratch_(workers_->count(), [this] { return Scratch(*this); }) {}

Rows<const float> FineCheck::run(const RgbPlanes& video, const StillPairs& still,
                                 Rows<const LookUpCell> lookUps, const TileWork& work,
                                 const FineMatch& match) {
    const Frame frame{video, still, lookUps, work};
    // The lambda captures only a pointer and a reference, so that std::function stores it without
    // allocating memory.
    workers_->forRange(work.tiles.height, 1, [this, &frame](int first, int last) {
        scratch_.with([&](Scratch& scratch) {
            for (int row = first; row < last; ++row)
                sumTiles(frame, scratch, row);
        });
    });
    workers_->forRange(cells_.height, kCellsPerTile, [this, &match](int first, int last) {
        for (int row = first; row < last; ++row)
            fineShareRow({near(ofVideo_, row), near(ofBoth_, row), near(ofStill_, row)}, match,
                         cells_.width, shares_[row]);
    });
    return {shares_[0], shares_.pitch(), cells_};
}

FineSumsNear::Pair FineCheck::near(CellPlane& sums, int row) const {
    return {sums[row / kFineStep], sums[std::min(divideUp(row, kFineStep), sampled_.height - 1)]};
}

void FineCheck::sumTiles(const Frame& frame, Scratch& scratch, int tileRow) {
    scratch.cells.clear();
    const int wholeCells = video_.width / kCell;
    forRuns(frame.work, tileRow, kCellsPerTile, wholeCells, [&](bool matched, int first, int last) {
        if (matched && first < last) append(scratch.cells, {first, last});
    });
    if (!scratch.cells.empty())
        scratch.lookUps.begin(frame.lookUps, taps_, false,
                              kSamples * kCell * scratch.cells.front().begin,
                              kSamples * kCell * scratch.cells.back().end);
    const int last = std::min(kCellsPerTile * (tileRow + 1), cells_.height);
    for (int row = kCellsPerTile * tileRow; row < last; row += kFineStep)
        sum(frame, scratch, row);
}

void FineCheck::sum(const Frame& frame, Scratch& scratch, int row) {
    const int sampled = row / kFineStep;
    const bool isWhole = kCell * (row + 1) <= video_.height;
    if (isWhole) {
        const int y = kCell * row + kFirst;
        std::array<std::int16_t*, kSamples * kBlock> still{};
        for (int k = 0; k < kSamples * kBlock; ++k) {
            still[k] = scratch.still[k];
            const LookUpRows lookUps =
                scratch.cells.empty() ? LookUpRows{} : scratch.lookUps.row(kSamples * y + k);
            for (const auto& [begin, end] : scratch.cells)
                warpRow(frame.still, lookUps, kSamples * kCell * begin, kSamples * kCell * end,
                        still[k]);
        }
        for (const auto& [begin, end] : scratch.cells) {
            for (int k = 0; k < kBlock; ++k)
                lumaEighthsRow({frame.video.row(0, y + k), frame.video.row(1, y + k),
                                frame.video.row(2, y + k)},
                               kCell * begin, kCell * end, scratch.video[k]);
            fineSumsRow({scratch.video[0], scratch.video[1]}, still, begin, end,
                        {ofVideo_[sampled], ofBoth_[sampled], ofStill_[sampled]});
        }
    }
    for (CellPlane* plane : {&ofVideo_, &ofBoth_, &ofStill_}) {
        // Clears the cells outside the spans. Vectors have written to some of them, because they
        // can be longer than the rest of a span.
        int done = 0;
        for (const auto& [begin, end] : scratch.cells) {
            if (!isWhole) break;
            std::fill((*plane)[sampled] + done, (*plane)[sampled] + begin, 0.0F);
            done = end;
        }
        std::fill((*plane)[sampled] + done, (*plane)[sampled] + cells_.width, 0.0F);
        plane->repeatBorder(sampled);
    }
}

}  // namespace mfar::simd
