#include "pipeline/flow/cell_field.h"
#include "pipeline/pipeline_state.h"

#include <cmath>

namespace mfar {
namespace {

constexpr float kSameSurface = 0.5F;  // [px]

/// One channel of a four-channel cell field at every video pixel.
void channelInto(std::vector<float>& out, int stride, int at, const std::vector<float>& cells,
                 Size cellCount, int channel, Size video) {
    std::size_t i = 0;
    for (int y = 0; y < video.height; ++y)
        for (int x = 0; x < video.width; ++x, ++i)
            out[i * stride + at] = sampleCells(cells, cellCount, channel, x, y);
}

std::size_t tileAt(int x, int y, Size video) {
    return static_cast<std::size_t>(y / kTileSize) * tilesOf(video).width + x / kTileSize;
}

}  // namespace

FrameStats Pipeline::readStats() const {
    FrameStats stats = state_->result.stats;
    const FrameStats drawn = state_->superres.statsNow();
    stats.tiles = drawn.tiles;
    stats.meanConfidence = drawn.meanConfidence;
    stats.explained = drawn.explained;
    stats.changed = drawn.changed;
    stats.searched2d = state_->flow.searched().count();
    return stats;
}

std::vector<float> Pipeline::readFlow() const {
    const State& s = *state_;
    if (!s.hasPrior) return {};
    const Size video = s.rig.video.size;
    const std::vector<float> cells = s.superres.cellField().readRgba32F();
    std::vector<float> out(2UL * video.width * video.height);
    for (int channel = 0; channel < 2; ++channel)
        channelInto(out, 2, channel, cells, s.superres.cellField().size(), channel, video);
    if (!s.flow.errorsGiven()) return out;
    // The cells' vectors are refined to a fraction of a pixel, the lines' are those of the pixels:
    // they say on which side of an edge a pixel lies.
    const std::vector<bool> searched = readSearchedTiles();
    const std::vector<float> alongLines = s.epipolar.flow();
    for (int y = 0; y < video.height; ++y)
        for (int x = 0; x < video.width; ++x) {
            const std::size_t i = 2 * (static_cast<std::size_t>(y) * video.width + x);
            const float apart = std::hypot(out[i] - alongLines[i], out[i + 1] - alongLines[i + 1]);
            const bool moves = searched[tileAt(x, y, video)] &&
                               s.epipolar.offLine(x, y, out[i], out[i + 1]) > kOffLine;
            if (apart < kSameSurface || moves) continue;
            out[i] = alongLines[i];
            out[i + 1] = alongLines[i + 1];
        }
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

std::vector<bool> Pipeline::readSearchedTiles() const {
    return state_->flow.searched().read();
}

std::vector<float> Pipeline::readShownObjects() const {
    return state_->objects ? state_->objects->readShown() : std::vector<float>();
}

std::vector<std::uint8_t> Pipeline::readImage() const {
    return state_->superres.output().readRgba8();
}

}  // namespace mfar
