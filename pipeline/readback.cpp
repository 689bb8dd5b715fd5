#include "pipeline/flow/cell_field.h"
#include "pipeline/pipeline_state.h"

#include <cmath>
#include <cstring>

namespace mfar {
namespace {

// Two flow vectors that differ by less [px] belong to the same surface.
constexpr float kSameSurface = 0.5F;

void channelInto(std::vector<float>& out, int stride, int at, const CellWeights& weights,
                 int channel, Size video) {
    const Rows<const WeighedCell> rows = weights.weighed.host();
    std::vector<float> cells;
    for (int y = 0; y < rows.size.height; ++y)
        for (int x = 0; x < rows.size.width; ++x)
            cells.insert(cells.end(),
                         {rows[y][x].x, rows[y][x].y, rows[y][x].weight, rows[y][x].confidence});
    std::size_t i = 0;
    for (int y = 0; y < video.height; ++y)
        for (int x = 0; x < video.width; ++x, ++i)
            out[i * stride + at] = sampleCells(cells, rows.size, channel, x, y);
}

std::size_t tileAt(int x, int y, Size video) {
    return static_cast<std::size_t>(y / kTileSize) * tilesOf(video).width + x / kTileSize;
}

}  // namespace

FrameStats Pipeline::readStats() const {
    FrameStats stats = state_->result.stats;
    state_->publishTiles(state_->detail->summary(), stats);
    stats.searched2d = state_->newest.flow->searchedCount();
    return stats;
}

std::vector<float> Pipeline::readFlow() const {
    const State& s = *state_;
    if (s.newest.lastFlow == nullptr) return {};
    const Size video = s.rig.video.size;
    std::vector<float> out(2UL * video.width * video.height);
    for (int channel = 0; channel < 2; ++channel)
        channelInto(out, 2, channel, *s.newest.lastWeights, channel, video);
    if (!s.newest.lastFlow->errorsGiven) return out;
    // Flow interpolated between cells is accurate to a fraction of a pixel, but does not show on
    // which side of a depth edge a pixel lies. The pixel's own vector from the epipolar search
    // shows this.
    const std::vector<bool> searched = readSearchedTiles();
    const std::vector<float> alongLines = s.epipolar->flow();
    for (int y = 0; y < video.height; ++y)
        for (int x = 0; x < video.width; ++x) {
            const std::size_t i = 2 * (static_cast<std::size_t>(y) * video.width + x);
            const float apart = std::hypot(out[i] - alongLines[i], out[i + 1] - alongLines[i + 1]);
            const bool moves = searched[tileAt(x, y, video)] &&
                               s.epipolar->offLine(x, y, out[i], out[i + 1]) > kOffLine;
            if (apart < kSameSurface || moves) continue;
            out[i] = alongLines[i];
            out[i + 1] = alongLines[i + 1];
        }
    return out;
}

std::vector<float> Pipeline::readConfidence() const {
    const State& s = *state_;
    if (s.newest.lastFlow == nullptr) return {};
    std::vector<float> out(1UL * s.rig.video.size.width * s.rig.video.size.height);
    channelInto(out, 1, 0, *s.newest.lastWeights, 3, s.rig.video.size);
    return out;
}

std::vector<TileClass> Pipeline::readTileClasses() const {
    return state_->detail->classes();
}

std::vector<bool> Pipeline::readSearchedTiles() const {
    return state_->newest.flow->searchedTiles();
}

std::vector<float> Pipeline::readShownObjects() const {
    return state_->objects ? state_->objects->readShown(state_->output) : std::vector<float>();
}

std::vector<std::uint8_t> Pipeline::readImage() const {
    const Rows<const std::uint32_t> rows = state_->detail->output().host();
    const std::size_t rowBytes = 4 * static_cast<std::size_t>(rows.size.width);
    std::vector<std::uint8_t> out(rowBytes * rows.size.height);
    for (int y = 0; y < rows.size.height; ++y)
        std::memcpy(out.data() + y * rowBytes, rows[y], rowBytes);
    return out;
}

std::optional<Timestamp> Pipeline::secondStill() const {
    const Reference& second = state_->second;
    return second.pictures != nullptr ? std::optional(second.time) : std::nullopt;
}

}  // namespace mfar
