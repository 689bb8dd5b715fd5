#include "tests/measure/train/training_pair.h"

#include "pipeline/enlarge/filter_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace mfar::train {
namespace {

using twin::Grey;

template <class ValueAt>
double meanOver(int at, double scale, const ValueAt& valueAt) {
    const double lo = at * scale, hi = lo + scale;
    double sum = 0;
    for (int i = static_cast<int>(lo); i < hi; ++i)
        sum += (std::min(hi, i + 1.0) - std::max(lo, double(i))) * valueAt(i);
    return sum / scale;
}

Grey areaMean(const Grey& sharp, Size to) {
    const double sx = double(sharp.size.width) / to.width,
                 sy = double(sharp.size.height) / to.height;
    const Grey narrow = twin::greyOf({to.width, sharp.size.height}, [&](int x, int y) {
        return meanOver(x, sx, [&](int i) { return sharp.at(i, y); });
    });
    return twin::greyOf(
        to, [&](int x, int y) { return meanOver(y, sy, [&](int i) { return narrow.at(x, i); }); });
}

Grey blurred(const Grey& g, double share) {
    const auto mix = [share](double a, double b, double c) { return b + share * (a + c - 2 * b); };
    const Grey rows = twin::greyOf(
        g.size, [&](int x, int y) { return mix(g.at(x - 1, y), g.at(x, y), g.at(x + 1, y)); });
    return twin::greyOf(g.size, [&](int x, int y) {
        return mix(rows.at(x, y - 1), rows.at(x, y), rows.at(x, y + 1));
    });
}

/// Normal noise by the Box-Muller transform, with the same numbers in every standard library.
class Noise {
public:
    explicit Noise(unsigned seed) : random_(seed) {}
    double operator()() {
        const double a = (random_() + 1.0) / 4294967297.0, b = random_() / 4294967296.0;
        return std::sqrt(-2 * std::log(a)) * std::cos(2 * std::numbers::pi * b);
    }

private:
    std::mt19937 random_;
};

}  // namespace

TrainingPair::TrainingPair(const Grey& sharp, const Sensor& sensor)
    : size_{static_cast<int>(std::lround(sharp.size.width * kScale)),
            static_cast<int>(std::lround(sharp.size.height * kScale))},
      luma_({size_.width + 2 * kMargin, size_.height}) {
    Grey video = areaMean(sharp, size_);
    if (sensor.blur > 0) video = blurred(video, sensor.blur);
    Noise noise(sensor.seed);
    for (double& value : video.values)
        value = std::clamp(std::round(value + sensor.noise * noise()), 0.0, 255.0);
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width + 2 * kMargin; ++x)
            luma_[y][x] = static_cast<std::int16_t>(enlarge::kLumaScale * video.at(x - kMargin, y));
    const Size grid{enlarge::kGrid * size_.width, enlarge::kGrid * size_.height};
    target_ = twin::enlarged(sharp, grid);
    const Grey cubic = twin::enlarged(video, grid);
    for (std::size_t i = 0; i < target_.values.size(); ++i)
        target_.values[i] -= cubic.values[i];
}

const std::int16_t* TrainingPair::row(int y) const {
    return luma_[std::clamp(y, 0, size_.height - 1)] + kMargin;
}

}  // namespace mfar::train
