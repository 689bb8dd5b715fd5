#include "pipeline/simd/compared_cells.h"

#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/enlarge_rows.h"
#include "pipeline/simd/still_look_up.h"

#include <algorithm>

namespace mfar::simd {

ComparedCells::ComparedCells(Size videoSize)
    : video(videoSize), cells(cellsOf(video)), flowX(cells), flowY(cells), compared(cells) {}

void ComparedCells::take(int row, const TileWork& work, const FlowCell* flow,
                         const ErrorCell* errors) {
    const std::size_t first = static_cast<std::size_t>(row) * cells.width;
    takeFlow(row, flow);
    const bool isWhole = kCell * (row + 1) <= video.height;
    const int wholeCells = isWhole ? video.width / kCell : 0;
    for (int x = 0; x < cells.width; ++x) {
        const bool matched = work.at(x / kCellsPerTile, row / kCellsPerTile).matched != 0;
        const bool isShown = errors == nullptr || errors[first + x].error < params::kNotShown;
        compared[row][x] = matched && x < wholeCells && isShown ? 1 : 0;
    }
    std::fill(compared[row] + cells.width, compared[row] + wholeVectors(cells).width, 0.0F);
}

void ComparedCells::takeFlow(int row, const FlowCell* flow) {
    splitFlow(flow + static_cast<std::size_t>(row) * cells.width, cells.width, flowX[row],
              flowY[row]);
    flowX.repeatBorder(row);
    flowY.repeatBorder(row);
}

AlignedRows<std::int16_t> ComparedCells::makeLuma() const {
    constexpr int kRoom = 64;  // number of pixels after a row that vectors can access
    return AlignedRows<std::int16_t>({kCell * wholeVectors(cells).width + kRoom, kCell});
}

void ComparedCells::takeLuma(const RgbPlanes& from, int row, int first, int last,
                             AlignedRows<std::int16_t>& to) const {
    for (int k = 0; k < kCell; ++k) {
        const int y = std::min(kCell * row + k, video.height - 1);
        lumaEighthsRow({from.row(0, y), from.row(1, y), from.row(2, y)}, kCell * first,
                       std::min(kCell * last, video.width), to[k]);
    }
}

}  // namespace mfar::simd
