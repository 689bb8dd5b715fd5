#include "pipeline/simd/row_taps.h"

#include "pipeline/engine/params/detail.h"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>
#include <vector>

namespace mfar::simd {
namespace {

struct At {
    At(int x, double step) : At((x + 0.5) * step - 0.5) {}
    explicit At(double position)
        : index(static_cast<int>(std::floor(position))), t(position - index) {}

    int index;
    double t;
};

double ratio(int from, int to) {
    return static_cast<double>(from) / to;
}

}  // namespace

RowTaps::RowTaps(int from, int to, const std::function<void(int, const Add&)>& sample) {
    std::vector<int> first(to);
    std::vector<std::vector<double>> weights(to);
    std::size_t taps = 1;
    for (int x = 0; x < to; ++x) {
        std::vector<std::pair<int, double>> samples;
        sample(x, [&](int index, double weight) {
            samples.emplace_back(std::clamp(index, 0, from - 1), weight);
        });
        const auto [least, most] = std::ranges::minmax(std::views::keys(samples));
        first[x] = least;
        weights[x].resize(most - least + 1);
        for (const auto& [index, weight] : samples)
            weights[x][index - least] += weight;
        taps = std::max(taps, weights[x].size());
    }
    first_ = AlignedRows<std::int32_t>({to, 1});
    weights_ = AlignedRows<float>({to, static_cast<int>(taps)});
    const int last = std::max(from - static_cast<int>(taps), 0);
    for (int x = 0; x < to; ++x) {
        const int from0 = std::min(first[x], last);
        first_[0][x] = from0;
        for (std::size_t k = 0; k < weights[x].size(); ++k)
            weights_[static_cast<int>(k) + first[x] - from0][x] = static_cast<float>(weights[x][k]);
    }
    // Vectors that read beyond the end use the last entry.
    std::fill(first_[0] + to, first_[0] + first_.pitch(), first_[0][to - 1]);
    for (int y = 0; y < to && taps <= 4; ++y)
        columns_.push_back(columnOf(y));
}

ColumnTaps RowTaps::columnOf(int y) const {
    ColumnTaps out{};
    int sum = 0, most = 0;
    for (int k = 0; k < 4; ++k) {
        out.rows[k] = first(y) + (k < taps() ? k : 0);
        if (k >= taps()) continue;
        out.weights[k] = static_cast<std::int16_t>(std::lround(weight(k, y) * 16384));
        sum += out.weights[k];
        if (out.weights[k] > out.weights[most]) most = k;
    }
    // The sum must be exactly one, so that uniform areas keep their brightness.
    out.weights[most] = static_cast<std::int16_t>(out.weights[most] + 16384 - sum);
    return out;
}

RowTaps RowTaps::cubic(int from, int to) {
    const double step = ratio(from, to);
    return {from, to, [&](int x, const Add& add) {
                constexpr double kA = params::kCubicSlope;
                const At at(x, step);
                const double t = at.t, s = 1 - t;
                const double w0 = kA * t * s * s, w3 = kA * s * t * t;
                const double w1 = ((kA + 2) * t - (kA + 3)) * t * t + 1;
                add(at.index - 1, w0);
                add(at.index, w1);
                add(at.index + 1, 1 - w0 - w1 - w3);
                add(at.index + 2, w3);
            }};
}

RowTaps RowTaps::linear(int from, int to) {
    return linear(from, to, ratio(from, to));
}

RowTaps RowTaps::linear(int from, int to, double step) {
    return {from, to, [&](int x, const Add& add) {
                const At at(x, step);
                add(at.index, 1 - at.t);
                add(at.index + 1, at.t);
            }};
}

RowTaps RowTaps::tent(int from, int to) {
    const double step = ratio(from, to);
    return {from, to, [&](int x, const Add& add) {
                const double centre = (x + 0.5) * step - 0.5;
                const int first = static_cast<int>(std::ceil(centre - step));
                double sum = 0;
                for (int i = first; i < centre + step; ++i)
                    sum += step - std::abs(i - centre);
                for (int i = first; i < centre + step; ++i)
                    add(i, (step - std::abs(i - centre)) / sum);
            }};
}

RowTaps RowTaps::mean(int from, int to, double footprint) {
    const double step = ratio(from, to);
    return {from, to, [&](int x, const Add& add) {
                for (const double off : {-1.5, -0.5, 0.5, 1.5}) {
                    const At at((x + 0.5 + off * footprint / 4) * step - 0.5);
                    add(at.index, 0.25 * (1 - at.t));
                    add(at.index + 1, 0.25 * at.t);
                }
            }};
}

}  // namespace mfar::simd
