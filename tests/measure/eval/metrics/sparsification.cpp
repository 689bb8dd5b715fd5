#include "tests/measure/eval/metrics/sparsification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace mfar::eval {
namespace {

constexpr double kNoArea = std::numeric_limits<double>::quiet_NaN();

/// Sorts errors by `key` and returns, for every k, the sum of the first k. Errors with equal keys
/// are replaced by their mean.
std::vector<double> sumsInOrder(std::span<const float> error, std::span<const float> key,
                                bool falling) {
    std::vector<std::size_t> order(error.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return falling ? key[a] > key[b] : key[a] < key[b];
    });
    std::vector<double> out{0};
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        double sum = 0;
        for (; end < order.size() && key[order[end]] == key[order[begin]]; ++end)
            sum += error[order[end]];
        const double mean = sum / static_cast<double>(end - begin), before = out.back();
        for (std::size_t i = 1; i <= end - begin; ++i)
            out.push_back(before + static_cast<double>(i) * mean);
    }
    return out;
}

/// `sums`: sums of the errors of the first 0, 1, 2, ... pixels in an order. Removes pixels from the
/// end of the order in steps. Returns for each step the mean error of the remaining pixels divided
/// by the mean error of all pixels.
std::vector<double> curveOf(const std::vector<double>& sums) {
    const std::size_t all = sums.size() - 1;
    const double mean = sums.back() / static_cast<double>(all);
    std::vector<double> out;
    for (std::size_t k = 0; k < Sparsification::kSteps; ++k) {
        const std::size_t left = std::max<std::size_t>(all - all * k / Sparsification::kSteps, 1);
        out.push_back(sums[left] / static_cast<double>(left) / mean);
    }
    return out;
}

double areaUnder(const std::vector<double>& curve) {
    return std::accumulate(curve.begin(), curve.end(), 0.0) / static_cast<double>(curve.size());
}

}  // namespace

Sparsification sparsification(std::span<const float> error, std::span<const float> confidence) {
    if (error.size() != confidence.size())
        throw std::invalid_argument(
            "sparsification: the numbers of confidences and errors must be equal");
    for (std::size_t i = 0; i < error.size(); ++i)
        if (!(error[i] >= 0 && std::isfinite(error[i]) && std::isfinite(confidence[i])))
            throw std::invalid_argument("sparsification: errors must be finite and not negative, "
                                        "confidences must be finite");
    if (std::all_of(error.begin(), error.end(), [](float e) { return e == 0; }))
        return {{}, {}, kNoArea, kNoArea};
    Sparsification out;
    out.byConfidence = curveOf(sumsInOrder(error, confidence, true));
    out.byError = curveOf(sumsInOrder(error, error, false));
    const double best = areaUnder(out.byError);
    out.ause = areaUnder(out.byConfidence) - best;
    // A random order leaves the mean error unchanged, so the area under its curve is 1.
    out.ausePerRandom = out.ause / (1 - best);
    return out;
}

}  // namespace mfar::eval
