#include "pipeline/enlarge/fine_match_learner.h"

#include "pipeline/engine/params/weigh.h"
#include "pipeline/enlarge/warped_grid.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::enlarge {
namespace {

constexpr std::size_t kLeastCells = 200;
constexpr double kMostStills = 8;
// A cell has structure if the variance of its finest detail exceeds this factor times the variance
// of the noise.
constexpr double kStructureOverNoise = 4;

/// Variances of a cell's finest detail in the video and in the still, and the covariance of the two
/// (`both`) [grey levels^2].
struct Sums {
    double video = 0, both = 0, still = 0;
};

/// Samples the still at video positions, as simd::FineCheck does.
class Sampler {
public:
    explicit Sampler(const MatchedPictures& pictures) : in_(pictures) {}

    [[nodiscard]] double pixel(int x, int y) const {
        double sum = 0;
        for (const double dy : {-0.25, 0.25})
            for (const double dx : {-0.25, 0.25})
                sum += sample(x + dx, y + dy);
        return sum / 4;
    }

private:
    [[nodiscard]] double sample(double px, double py) const {
        const LookUpCell offset = lookUpAt(in_.lookUps, px, py);
        const double x = (px + 0.5) * in_.scaleX - 0.5 + offset.x,
                     y = (py + 0.5) * in_.scaleY - 0.5 + offset.y;
        return still((x + 0.5) * in_.stillPerX - 0.5, (y + 0.5) * in_.stillPerY - 0.5);
    }
    [[nodiscard]] double still(double x, double y) const {
        const Size size = in_.still.size();
        x = std::clamp(x, 0.0, size.width - 1.0);
        y = std::clamp(y, 0.0, size.height - 1.0);
        const int left = static_cast<int>(x), top = static_cast<int>(y);
        const int right = std::min(left + 1, size.width - 1);
        const auto row = [&](int at) {
            return std::lerp(double(in_.still[at][left]), double(in_.still[at][right]), x - left);
        };
        return std::lerp(row(top), row(std::min(top + 1, size.height - 1)), y - top);
    }

    const MatchedPictures& in_;
};

Sums sumsOf(const MatchedPictures& pictures, const Sampler& sampler, int column, int row) {
    std::array<std::array<Sums, kCell + 1>, 2> at;  // two rows of pixels
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i <= kCell; ++i) {
            const int x = std::min(kCell * column + i, pictures.video.width - 1),
                      y = kCell * row + 1 + j;
            at[j][i].video = pictures.row(y)[x] / double(kLumaScale);
            at[j][i].still = sampler.pixel(x, y);
        }
    Sums out;
    const auto add = [&out](const Sums& from, const Sums& to) {
        const double a = to.video - from.video, b = to.still - from.still;
        out.video += a * a / 24;
        out.both += a * b / 24;
        out.still += b * b / 24;
    };
    for (int i = 0; i < kCell; ++i) {
        add(at[0][i], at[0][i + 1]);
        add(at[1][i], at[1][i + 1]);
        add(at[0][i], at[1][i]);
    }
    return out;
}

double quantile(std::vector<double>& values, double share) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * double(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Two variances of each cell, from which FineMatch is learned. `video` is the variance of the
/// video's finest detail. `rest` is the part of it that the still does not predict.
struct Unexplained {
    std::vector<double> video, rest;
};

Unexplained unexplainedOf(const MatchedPictures& pictures, const std::stop_token& stop) {
    const Size cells{pictures.video.width / kCell, pictures.video.height / kCell};
    const Sampler sampler(pictures);
    std::vector<Sums> sums(static_cast<std::size_t>(cells.width) * cells.height);
    const auto at = [&](int x, int y) -> Sums& {
        return sums[static_cast<std::size_t>(y) * cells.width + x];
    };
    for (int y = 0; y < cells.height && !stop.stop_requested(); ++y)
        for (int x = 0; x < cells.width; ++x)
            if (mayTeach(pictures.lookUps[y][x])) at(x, y) = sumsOf(pictures, sampler, x, y);
    Unexplained out;
    for (int y = 1; y < cells.height - 1; ++y)
        for (int x = 1; x < cells.width - 1; ++x) {
            Sums mean;
            bool all = true;
            for (int k = 0; k < 9; ++k) {
                const int i = x + k % 3 - 1, j = y + k / 3 - 1;
                const double weight = (i == x ? 2 : 1) * (j == y ? 2 : 1) / 16.0;
                all = all && mayTeach(pictures.lookUps[j][i]);
                mean.video += weight * at(i, j).video;
                mean.both += weight * at(i, j).both;
                mean.still += weight * at(i, j).still;
            }
            if (!all) continue;
            const double both = std::max(mean.both, 0.0);
            out.video.push_back(mean.video);
            out.rest.push_back(mean.video - both * both / (mean.still + params::kFineLeast));
        }
    return out;
}

}  // namespace

bool FineMatchLearner::add(const MatchedPictures& pictures, const std::stop_token& stop) {
    const Unexplained cells = unexplainedOf(pictures, stop);
    if (stop.stop_requested() || cells.video.size() < kLeastCells) return false;
    std::vector<double> values = cells.rest;
    const double noise = std::max(quantile(values, 0.1), double(params::kFineLeast));
    values.clear();
    for (std::size_t i = 0; i < cells.video.size(); ++i)
        if (cells.video[i] > kStructureOverNoise * noise)
            values.push_back(std::max(cells.rest[i] - noise, 0.0) / cells.video[i]);
    if (values.size() < kLeastCells) return false;
    const FineMatch found{static_cast<float>(std::min(noise, double(FineMatch::kMostNoise))),
                          static_cast<float>(std::min(quantile(values, 0.5), 1.0))};
    stills_ = std::min(stills_ + 1, kMostStills);
    const auto newest = static_cast<float>(1 / stills_);
    match_.noise += newest * (found.noise - match_.noise);
    match_.share += newest * (found.share - match_.share);
    return true;
}

std::array<double, FineMatchLearner::kNumbers> FineMatchLearner::stored() const {
    return {stills_, match_.noise, match_.share};
}

bool FineMatchLearner::restore(const std::array<double, kNumbers>& numbers) {
    const FineMatch match{static_cast<float>(numbers[1]), static_cast<float>(numbers[2])};
    if (!(numbers[0] >= 0 && numbers[0] <= kMostStills) || !match.isValid()) return false;
    stills_ = numbers[0];
    match_ = match;
    return true;
}

}  // namespace mfar::enlarge
