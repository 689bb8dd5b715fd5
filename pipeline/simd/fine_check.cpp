#include "pipeline/simd/fine_check.h"

#include "pipeline/engine/params/weigh.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/enlarge_rows.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace mfar::simd {
namespace {

constexpr int kRows = 2;                     // number of pixel rows of a cell that are compared
constexpr int kFirst = (kCell - kRows) / 2;  // the first of them
constexpr int kRoom = 64;                    // number of pixels after a row that vectors can access

}  // namespace

FineCheck::Scratch::Scratch(const FineCheck& check)
    : lookUps(check.cells_, kSamples * check.video_.width),
      video({check.video_.width + kRoom, kRows}),
      still({kSamples * (check.video_.width + kRoom), kSamples * kRows}) {
    cells.reserve(static_cast<std::size_t>(check.cells_.width));
}

FineCheck::FineCheck(const StereoRig& stillRig, std::shared_ptr<Workers> workers)
    : video_(stillRig.video.size), cells_(cellsOf(video_)), workers_(std::move(workers)),
      taps_(stillRig, {kSamples * video_.width, kSamples * video_.height}), ofVideo_(cells_),
      ofBoth_(cells_), ofStill_(cells_), shares_(wholeVectors(cells_)),
      scratch_(workers_->count(), [this] { return Scratch(*this); }) {}

Rows<const float> FineCheck::run(const RgbPlanes& video, const StillPairs& still,
                                 Rows<const LookUpCell> lookUps, const SurfaceCells& surface,
                                 const TileWork& work, const FineMatch& match) {
    const Frame frame{video, still, lookUps, work};
    // The lambda captures only a pointer and a reference, so that std::function stores it without
    // allocating memory.
    workers_->forRange(work.tiles.height, 1, [this, &frame](int first, int last) {
        scratch_.with([&](Scratch& scratch) {
            for (int row = first; row < last; ++row)
                sumTiles(frame, scratch, row);
        });
    });
    const auto shares = [&](int first, int last) {
        for (int row = first; row < last; ++row)
            fineShareRow({ofVideo_.around(row), ofBoth_.around(row), ofStill_.around(row)},
                         surface.kink[row], surface.variance[row], match, cells_.width,
                         shares_[row]);
    };
    workers_->forRange(cells_.height, kCellsPerTile, std::ref(shares));
    return {shares_[0], shares_.pitch(), cells_};
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
                              kSamples * pixelsOf(scratch.cells.back().end));
    const int last = std::min(kCellsPerTile * (tileRow + 1), cells_.height);
    for (int row = kCellsPerTile * tileRow; row < last; ++row)
        sum(frame, scratch, row);
}

int FineCheck::pixelsOf(int cells) const {
    return std::min(kCell * cells + 1, video_.width);
}

void FineCheck::sum(const Frame& frame, Scratch& scratch, int row) {
    const bool isWhole = kCell * (row + 1) <= video_.height;
    if (isWhole) {
        const int y = kCell * row + kFirst;
        std::array<std::int16_t*, kSamples * kRows> still{};
        for (int k = 0; k < kSamples * kRows; ++k) {
            still[k] = scratch.still[k];
            const LookUpRows lookUps =
                scratch.cells.empty() ? LookUpRows{} : scratch.lookUps.row(kSamples * y + k);
            for (const auto& [begin, end] : scratch.cells)
                warpRow(frame.still, lookUps, kSamples * kCell * begin, kSamples * pixelsOf(end),
                        still[k]);
        }
        for (const auto& [begin, end] : scratch.cells) {
            for (int k = 0; k < kRows; ++k)
                lumaEighthsRow({frame.video.row(0, y + k), frame.video.row(1, y + k),
                                frame.video.row(2, y + k)},
                               kCell * begin, pixelsOf(end), scratch.video[k]);
            fineSumsRow({scratch.video[0], scratch.video[1]}, still, begin, end, video_.width,
                        {ofVideo_[row], ofBoth_[row], ofStill_[row]});
        }
    }
    for (CellPlane* plane : {&ofVideo_, &ofBoth_, &ofStill_}) {
        // Clears the cells outside the spans. Some of them were written to, because a vector can be
        // longer than the rest of a span.
        int done = 0;
        for (const auto& [begin, end] : scratch.cells) {
            if (!isWhole) break;
            std::fill((*plane)[row] + done, (*plane)[row] + begin, 0.0F);
            done = end;
        }
        std::fill((*plane)[row] + done, (*plane)[row] + cells_.width, 0.0F);
        plane->repeatBorder(row);
    }
}

}  // namespace mfar::simd
