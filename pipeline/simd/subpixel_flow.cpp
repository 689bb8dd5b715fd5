#include "pipeline/simd/subpixel_flow.h"

#include "pipeline/engine/params/flow.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <utility>

namespace mfar::simd {
namespace {

template <std::size_t Count>
std::array<CellPlane, Count> planes(Size cells) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
        return std::array{(static_cast<void>(I), CellPlane(cells))...};
    }(std::make_index_sequence<Count>());
}

}  // namespace

SubpixelFlow::SubpixelFlow(const StereoRig& stillRig, std::shared_ptr<Workers> workers)
    : lookUp_(stillRig), cells_(cellsOf(stillRig.video.size)), workers_(std::move(workers)),
      given_(stillRig.video.size), choice_(stillRig, workers_, given_), none_({cells_.width, 1}),
      alongX_(planes<2>(cells_)), alongY_(planes<2>(cells_)), corrected_(planes<2>(cells_)),
      sums_(planes<kSubpixelSums>(cells_)),
      luma_(workers_->count(), [this] { return given_.makeLuma(); }) {}

void SubpixelFlow::run(const RgbPlanes& video, const StillPairs& still, float light,
                       const TileWork& work, FlowCell* flow, const ErrorCell* errors) {
    const Frame frame{video, still, light, work, flow};
    const auto forCellRows = [&](const auto& body) {
        forRows(workers_.get(), 0, cells_.height, kCellsPerTile, body);
    };
    forCellRows([&](int row) { given_.take(row, work, flow, errors); });
    choice_.run(frame);
    forCellRows([&](int row) { given_.takeFlow(row, flow); });
    workers_->forRange(cells_.height, kCellsPerTile, [&](int first, int last) {
        luma_.with([&](AlignedRows<std::int16_t>& luma) {
            for (int row = first; row < last; ++row) {
                makeSlopes(row);
                sum(frame, luma, row);
            }
        });
    });
    forCellRows([&](int row) { correct(frame, row); });
}

void SubpixelFlow::makeSlopes(int row) {
    const int width = cells_.width;
    const int r = std::clamp(row, 2, std::max(cells_.height - 3, 2));
    const int above = std::min(r - 2, cells_.height - 1), here = std::min(r, cells_.height - 1),
              below = std::min(r + 2, cells_.height - 1);
    for (int k = 0; k < 2; ++k) {
        CellPlane& flow = k == 0 ? given_.flowX : given_.flowY;
        const float *u = flow[row], *a = flow[above], *h = flow[here], *b = flow[below];
        float *x = alongX_[k][row], *y = alongY_[k][row];
        for (int c = 0; c < width; ++c) {
            const int m = std::clamp(c, 2, std::max(width - 3, 2));
            x[c] = slopeOf(u[m - 2], u[std::min(m, width - 1)], u[std::min(m + 2, width - 1)]);
            y[c] = slopeOf(a[c], h[c], b[c]);
        }
    }
}

void SubpixelFlow::sum(const Frame& frame, AlignedRows<std::int16_t>& luma, int row) {
    std::array<float*, kSubpixelSums> to{};
    for (std::size_t k = 0; k < to.size(); ++k)
        to[k] = sums_[k][row];
    SubpixelCells cells{row,
                        given_.flowX[row],
                        given_.flowY[row],
                        {alongX_[0][row], alongX_[1][row]},
                        {alongY_[0][row], alongY_[1][row]},
                        given_.compared[row],
                        {},
                        frame.light};
    for (int k = 0; k < kCell; ++k)
        cells.video[k] = luma[k];
    forRuns(frame.work, row / kCellsPerTile, kCellsPerTile, cells_.width,
            [&](bool matched, int first, int last) {
                for (float* sums : to)
                    std::fill(sums + first, sums + last, 0.0F);
                if (!matched) return;
                given_.takeLuma(frame.video, row, first, last, luma);
                subpixelSumsRow(lookUp_, frame.still, cells, first, last, to);
            });
    // Cells outside the picture do not count.
    for (float* sums : to)
        sums[-1] = sums[cells_.width] = 0;
}

void SubpixelFlow::correct(const Frame& frame, int row) {
    SubpixelAround in{{},
                      given_.flowX.around(row),
                      given_.flowY.around(row),
                      {alongX_[0][row], alongX_[1][row]},
                      {alongY_[0][row], alongY_[1][row]},
                      static_cast<float>(frame.work.noise)};
    for (std::size_t k = 0; k < in.sums.size(); ++k) {
        in.sums[k] = sums_[k].around(row);
        if (row == 0) in.sums[k].above = none_[0];
        if (row == cells_.height - 1) in.sums[k].below = none_[0];
    }
    float *x = corrected_[0][row], *y = corrected_[1][row];
    FlowCell* flow = frame.flow + static_cast<std::size_t>(row) * cells_.width;
    forRuns(frame.work, row / kCellsPerTile, kCellsPerTile, cells_.width,
            [&](bool matched, int first, int last) {
                if (!matched) return;
                subpixelStepRow(in, first, last, x, y);
                for (int c = first; c < last; ++c) {
                    flow[c].x = x[c];
                    flow[c].y = y[c];
                }
            });
}

}  // namespace mfar::simd
