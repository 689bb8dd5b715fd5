#include "daemon/histogram.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr double kLeastMs = 1e-3;

}  // namespace

double TimeBuckets::of(double ms) const {
    // This comparison is false for NaN, so NaN counts as the shortest time.
    return ms > kLeastMs ? std::log2(ms / kLeastMs) * perOctave : 0;
}

double TimeBuckets::middleMs(double bucket) const {
    return kLeastMs * std::exp2((bucket + 0.5) / perOctave);
}

void Histogram::add(double ms) {
    const double last = static_cast<double>(buckets_.size() - 1);
    ++buckets_[static_cast<std::size_t>(std::min(kBuckets.of(ms), last))];
    ++count_;
}

double Histogram::quantile(double q) const {
    if (count_ == 0) return 0;
    const double rank = std::clamp(q, 0.0, 1.0) * static_cast<double>(count_);
    double seen = 0;
    std::size_t i = 0;
    for (; i + 1 < buckets_.size(); ++i) {
        seen += buckets_[i];
        if (seen >= rank && seen > 0) break;
    }
    return kBuckets.middleMs(static_cast<double>(i));
}

}  // namespace mfar
