#include "pipeline/simd/weigh_step.h"

#include "pipeline/engine/params/weigh.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace mfar::simd {
namespace {

PatchLevel patchLevel(std::span<const std::uint32_t> words, const LumaLevel& level) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(words.data());
    const std::ptrdiff_t first = 4 * (std::ptrdiff_t{level.offset} + kLumaMarginWords);
    return {bytes + first, 4 * static_cast<std::ptrdiff_t>(level.pitch), level.width, level.height};
}

}  // namespace

WeighStep::WeighStep(const StereoRig& stillRig, std::shared_ptr<Workers> workers)
    : params_(stillRig), workers_(std::move(workers)), cells_(cellsOf(stillRig.video.size)),
      halfCells_(
          cellsOf({(stillRig.video.size.width + 1) / 2, (stillRig.video.size.height + 1) / 2})),
      flowX_(cells_), flowY_(cells_), covariance_(cells_), varianceVideo_(cells_),
      varianceStill_(cells_), confidence_(cells_), lookX_(cells_), lookY_(cells_),
      halfFlowX_(halfCells_), halfFlowY_(halfCells_), halfCovariance_(halfCells_),
      halfVarianceStill_(halfCells_), weighed_(wholeVectors(cells_)),
      lookUps_(wholeVectors(cells_)), trust_(wholeVectors(cells_)), kink_(wholeVectors(cells_)),
      variance_(wholeVectors(cells_)) {}

void WeighStep::run(const WeighInput& in) {
    assert(in.forward.size == cells_);
    if (in.work.changed == 0) return;
    forRows(workers_.get(), 0, in.work.tiles.height, 1,
            [&](int tileRow) { assessTiles(in, tileRow); });
    const auto noise = static_cast<float>(in.work.noise);
    forRows(workers_.get(), 0, cells_.height, kCellsPerTile, [&](int row) { weigh(row, noise); });
}

void WeighStep::assessTiles(const WeighInput& in, int tileRow) {
    const int last = std::min(kCellsPerTile * (tileRow + 1), cells_.height);
    for (int row = kCellsPerTile * tileRow; row < last; ++row)
        assess(in, row);
    if (in.work.matched == 0) return;
    const int lastHalf = std::min(kCellsPerTile / 2 * (tileRow + 1), halfCells_.height);
    for (int row = kCellsPerTile / 2 * tileRow; row < lastHalf; ++row)
        measureGain(in, row);
}

BackwardCells WeighStep::backwardOf(const WeighInput& in, int row) const {
    if (in.errors.data != nullptr) return {.errors = in.errors[row]};
    return {.errors = nullptr,
            .field = in.backward.data,
            .pitch = in.backward.pitch,
            .columns = in.backward.size.width,
            .rows = in.backward.size.height,
            .scale = static_cast<float>(1 << in.backwardLevel)};
}

void WeighStep::assess(const WeighInput& in, int row) {
    splitFlow(in.forward[row], cells_.width, flowX_[row], flowY_[row]);
    flowX_.repeatBorder(row);
    flowY_.repeatBorder(row);
    const PatchLevel video = patchLevel(in.words, in.videoLuma[0]);
    const PatchLevel still = patchLevel(in.words, in.stillLuma[0]);
    const PatchSums sums{covariance_[row], varianceVideo_[row], varianceStill_[row]};
    forRuns(in.work, row / kCellsPerTile, kCellsPerTile, cells_.width,
            [&](bool matched, int first, int last) {
                if (matched) {
                    comparePatches(video, still, row, first, last, flowX_[row], flowY_[row], sums);
                    return;
                }
                for (float* sum : {sums.covariance, sums.varianceVideo, sums.varianceStill})
                    std::fill(sum + first, sum + last, 0.0F);
            });
    if (in.errors.data != nullptr) takeDirect(in.errors[row], sums);
    for (CellPlane* plane : {&covariance_, &varianceVideo_, &varianceStill_})
        plane->repeatBorder(row);
    lookUpCells(
        params_, backwardOf(in, row),
        {row, cells_.width, flowX_[row], flowY_[row], lookX_[row], lookY_[row], confidence_[row]});
}

void WeighStep::takeDirect(const ErrorCell* cells, const PatchSums& sums) const {
    for (int x = 0; x < cells_.width; ++x) {
        if (!(cells[x].covariance > 0)) continue;
        sums.covariance[x] = cells[x].covariance;
        sums.varianceVideo[x] = cells[x].varianceVideo;
        sums.varianceStill[x] = cells[x].varianceStill;
    }
}

void WeighStep::measureGain(const WeighInput& in, int row) {
    const int upper = 2 * row, lower = std::min(2 * row + 1, cells_.height - 1);
    halveFlow(flowX_[upper], flowX_[lower], halfCells_.width, halfFlowX_[row]);
    halveFlow(flowY_[upper], flowY_[lower], halfCells_.width, halfFlowY_[row]);
    const PatchLevel video = patchLevel(in.words, in.videoLuma[1]);
    const PatchLevel still = patchLevel(in.words, in.stillLuma[1]);
    const PatchSums sums{halfCovariance_[row], nullptr, halfVarianceStill_[row]};
    constexpr int kPerTile = kCellsPerTile / 2;
    forRuns(in.work, row / kPerTile, kPerTile, halfCells_.width,
            [&](bool matched, int first, int last) {
                if (matched) {
                    comparePatches(video, still, row, first, last, halfFlowX_[row], halfFlowY_[row],
                                   sums);
                    return;
                }
                std::fill(sums.covariance + first, sums.covariance + last, 0.0F);
                std::fill(sums.varianceStill + first, sums.varianceStill + last, 0.0F);
            });
    halfCovariance_.repeatBorder(row);
    halfVarianceStill_.repeatBorder(row);
}

void WeighStep::confirm(Rows<const float> shares) {
    forRows(workers_.get(), 0, cells_.height, kCellsPerTile, [&](int row) {
        const float* share = shares[row];
        for (int x = 0; x < cells_.width; ++x) {
            float& weight = weighed_[row][x].weight;
            const float lack = (1 - weight) * (1 - weight);
            weight = share[x] * (weight < 1 ? 1 - lack * lack : weight);
            lookUps_[row][x].weight = weight;
            trust_[row][x].halfWeight = std::min(0.5F * weight, 1.0F);
        }
    });
}

void WeighStep::weigh(int row, float noise) {
    const int near = row / 2;
    const int other = std::clamp(near + (row % 2 == 0 ? -1 : 1), 0, halfCells_.height - 1);
    weighCells({.count = cells_.width,
                .flowX = flowX_.around(row),
                .flowY = flowY_.around(row),
                .flowX2 = flowX_.around(std::min(row + 1, cells_.height - 1)).below,
                .flowY2 = flowY_.around(std::min(row + 1, cells_.height - 1)).below,
                .covariance = covariance_.around(row),
                .varianceVideo = varianceVideo_.around(row),
                .varianceStill = varianceStill_.around(row),
                .confidence = confidence_[row],
                .lookX = lookX_[row],
                .lookY = lookY_[row],
                .halfCovariance = {halfCovariance_[near], halfCovariance_[other]},
                .halfVarianceStill = {halfVarianceStill_[near], halfVarianceStill_[other]},
                .weighed = weighed_[row],
                .lookUps = lookUps_[row],
                .trust = trust_[row],
                .kink = kink_[row],
                .variance = variance_[row]},
               noise);
}

}  // namespace mfar::simd
