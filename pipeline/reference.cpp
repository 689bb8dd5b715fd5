#include "pipeline/reference.h"

#include "pipeline/simd/still_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar {
namespace {

constexpr double kFollows = 1.0 / 8;  // weight of the newest frame in the mean Reference::shows
// Two stills count as taken from the same position if the cells have moved by less than this in the
// mean [video px]. The areas that the two stills miss then differ by less than a tile.
constexpr double kSameView = 0.5 * kTileSize;

}  // namespace

void Reference::take(const ImageView& picture, Timestamp taken, SuperResMode mode,
                     const FilterBank& filters) {
    time = taken;
    pictures = &still->run(picture, mode, filters.tone(), simd::noiseOfStill(picture));
    pyramid->still(*pictures, filters.guidance().light);
    lastFlow = nullptr;
    shows = 1;
    first.clear();
}

void Reference::drop() {
    pictures = nullptr;
    lastFlow = nullptr;
}

void Reference::count(int tiles, int shown) {
    if (tiles > 0) shows += kFollows * (static_cast<double>(shown) / tiles - shows);
}

void Reference::keepFirst() {
    const Rows<const WeighedCell> cells = lastWeights->weighed.host();
    first.resize(static_cast<std::size_t>(cells.size.width) * cells.size.height);
    for (int y = 0; y < cells.size.height; ++y)
        std::copy_n(cells[y], cells.size.width,
                    first.begin() + static_cast<std::ptrdiff_t>(y) * cells.size.width);
}

double Reference::moved() const {
    if (first.empty()) return 0;
    if (lastFlow == nullptr) return std::numeric_limits<double>::infinity();
    const Rows<const WeighedCell> cells = lastWeights->weighed.host();
    double sum = 0;
    int count = 0;
    for (int y = 0; y < cells.size.height; ++y)
        for (int x = 0; x < cells.size.width; ++x) {
            const WeighedCell& then = first[static_cast<std::size_t>(y) * cells.size.width + x];
            const WeighedCell& now = cells[y][x];
            const float way = std::hypot(now.x - then.x, now.y - then.y);
            if (!(then.weight > 0 && now.weight > 0 && std::isfinite(way))) continue;
            sum += way;
            ++count;
        }
    return count > 0 ? sum / count : std::numeric_limits<double>::infinity();
}

bool keepsOlder(const Reference& older, const Reference& newest) {
    if (older.pictures == nullptr) return false;
    return newest.moved() < kSameView || older.shows > newest.shows;
}

}  // namespace mfar
