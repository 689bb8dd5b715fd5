#include "daemon/histogram.h"

#include <algorithm>
#include <cmath>

namespace mfar {

void Histogram::add(double ms) {
    // The condition is written so that NaN is counted in the bucket of the shortest times.
    const double octaves = ms > kLeastMs ? std::log2(ms / kLeastMs) : 0;
    const double last = static_cast<double>(buckets_.size() - 1);
    const double bucket = std::min(octaves * kBucketsPerOctave, last);
    ++buckets_[static_cast<std::size_t>(bucket)];
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
    const double middle = (static_cast<double>(i) + 0.5) / kBucketsPerOctave;
    return kLeastMs * std::exp2(middle);
}

}  // namespace mfar
