#include "pipeline/flow/cell_field.h"
#include "pipeline/pipeline_state.h"

namespace mfar {
namespace {

/// One channel of a four-channel cell field at every video pixel.
void channelInto(std::vector<float>& out, int stride, int at, const std::vector<float>& cells,
                 Size cellCount, int channel, Size video) {
    std::size_t i = 0;
    for (int y = 0; y < video.height; ++y)
        for (int x = 0; x < video.width; ++x, ++i)
            out[i * stride + at] = sampleCells(cells, cellCount, channel, x, y);
}

}  // namespace

FrameStats Pipeline::readStats() const {
    FrameStats stats = state_->superres.statsNow();
    stats.usedStill = state_->result.stats.usedStill;
    return stats;
}

std::vector<float> Pipeline::readFlow() const {
    const State& s = *state_;
    if (!s.hasPrior) return {};
    if (s.flow.errorsGiven()) return s.epipolar.flow();
    const std::vector<float> cells = s.superres.cellField().readRgba32F();
    std::vector<float> out(2UL * s.rig.video.size.width * s.rig.video.size.height);
    for (int channel = 0; channel < 2; ++channel)
        channelInto(out, 2, channel, cells, s.superres.cellField().size(), channel,
                    s.rig.video.size);
    return out;
}

std::vector<float> Pipeline::readConfidence() const {
    const State& s = *state_;
    if (!s.hasPrior) return {};
    const std::vector<float> cells = s.superres.cellField().readRgba32F();
    std::vector<float> out(1UL * s.rig.video.size.width * s.rig.video.size.height);
    channelInto(out, 1, 0, cells, s.superres.cellField().size(), 3, s.rig.video.size);
    return out;
}

std::vector<TileClass> Pipeline::readTileClasses() const {
    return state_->superres.readClasses();
}

std::vector<std::uint8_t> Pipeline::readImage() const {
    return state_->superres.output().readRgba8();
}

}  // namespace mfar
