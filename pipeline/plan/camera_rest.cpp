#include "pipeline/plan/camera_rest.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr long kMemory = 64;  // number of frames for which a change of a tile is remembered
constexpr long kNever = -kMemory;
// Largest share of the tiles with structure that may change while the camera rests.
constexpr double kMostChanged = 0.25;
// While the camera rests, at most this number of recent frames may draw more than kMostChanged of
// the tiles although these have not changed. A frame counts less the older it is: after
// kRenewalTime [s], its weight is 1/e. Each new still causes one such frame, so two stills per
// second count as about four.
constexpr double kMostRenewals = 6, kRenewalTime = 2;
// Smallest share of tiles with structure with which a motion of the camera is noticed.
constexpr double kLeastStructured = 0.1;

}  // namespace

void CameraRest::add(const std::vector<TileMeasure>& tiles, double leastStructure,
                     double renewedShare, Timestamp time) {
    const double passed = secondsBetween(last_, time);
    renewals_ *= std::exp(-std::max(passed, 0.0) / kRenewalTime);
    if (renewedShare > kMostChanged) ++renewals_;
    changed_.resize(tiles.size(), kNever);
    ++frame_;
    last_ = time;
    int structured = 0, changed = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (tiles[i].changed) changed_[i] = frame_;
        if (!(static_cast<double>(tiles[i].structure) > leastStructure)) continue;
        ++structured;
        changed += frame_ - changed_[i] < kMemory ? 1 : 0;
    }
    if (!(structured > kLeastStructured * static_cast<double>(tiles.size()))) {
        since_.reset();
    } else if (!since_ || changed > kMostChanged * structured || renewals_ > kMostRenewals) {
        since_ = time;
        changed_.assign(tiles.size(), kNever);
    }
}

}  // namespace mfar
