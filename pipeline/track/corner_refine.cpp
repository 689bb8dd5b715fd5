#include "pipeline/track/corner_refine.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mfar {
namespace {

using Eigen::Vector2d;

constexpr double kStep = 0.25;       // distance between samples along the edge's normal [px]
constexpr double kMostReach = 2.5;   // largest distance of a sample from the edge [px]
constexpr double kEnds = 0.08;       // ignored fraction at each end of an edge: corners look round
constexpr double kFarthestMove = 2;  // largest shift of a corner or an edge point [px]
constexpr double kLeastContrast = 0.006;  // smallest contrast of an edge [linear light, 1 is white]

class Light {
public:
    Light(const ImageView& luma, const std::array<double, 256>& table)
        : luma_(luma), table_(table) {}

    [[nodiscard]] std::optional<double> at(const Vector2d& p) const {
        if (!(p.x() >= 0 && p.y() >= 0 && p.x() < luma_.size.width - 1 &&
              p.y() < luma_.size.height - 1))
            return std::nullopt;
        const int x = static_cast<int>(p.x()), y = static_cast<int>(p.y());
        const double u = p.x() - x, v = p.y() - y;
        const std::uint8_t* row = luma_.data + y * luma_.stride + x;
        return (1 - v) * ((1 - u) * table_[row[0]] + u * table_[row[1]]) +
               v * ((1 - u) * table_[row[luma_.stride]] + u * table_[row[luma_.stride + 1]]);
    }

private:
    const ImageView& luma_;
    const std::array<double, 256>& table_;
};

struct EdgePoint {
    Vector2d pixel;
    double weight;
};

/// Finds the brightness step of an edge near `middle`. `normal` is perpendicular to the edge and
/// points from dark to bright. The step is at the mean position along `normal`, weighted with the
/// increase of light at each position. This is done twice; the second time, the search window is
/// centred on the first result.
std::optional<EdgePoint> findStep(const Light& light, const Vector2d& middle,
                                  const Vector2d& normal, double reach) {
    double centre = 0, contrast = 0;
    for (int turn = 0; turn < 2; ++turn) {
        double sum = 0, moment = 0;
        std::optional<double> before = light.at(middle + (centre - reach) * normal);
        for (double s = centre - reach; s < centre + reach - kStep / 2; s += kStep) {
            const std::optional<double> after = light.at(middle + (s + kStep) * normal);
            if (!before || !after) return std::nullopt;
            const double rise = std::max(0., *after - *before);
            sum += rise;
            moment += rise * (s + kStep / 2);
            before = after;
        }
        if (!(sum > kLeastContrast)) return std::nullopt;
        centre = moment / sum;
        contrast = sum;
        if (!(std::abs(centre) < kFarthestMove)) return std::nullopt;
    }
    return EdgePoint{middle + centre * normal, contrast};
}

struct Line {
    Vector2d n;
    double d;
};

/// Fits a line by total least squares, then again without the outliers of the first fit.
std::optional<Line> fitLine(std::vector<EdgePoint> points) {
    Line line{};
    for (int turn = 0; turn < 2; ++turn) {
        if (points.size() < 4) return std::nullopt;
        double sum = 0;
        Vector2d mean = Vector2d::Zero();
        for (const EdgePoint& p : points) {
            mean += p.weight * p.pixel;
            sum += p.weight;
        }
        mean /= sum;
        Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
        for (const EdgePoint& p : points)
            spread += p.weight * (p.pixel - mean) * (p.pixel - mean).transpose();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(spread);
        line.n = eigen.eigenvectors().col(0);
        line.d = line.n.dot(mean);
        const double limit = 3 * std::sqrt(std::max(eigen.eigenvalues()(0), 0.) / sum);
        std::erase_if(points, [&](const EdgePoint& p) {
            return std::abs(line.n.dot(p.pixel) - line.d) > limit;
        });
    }
    return line;
}

std::optional<Vector2d> intersect(const Line& a, const Line& b) {
    const double det = a.n.x() * b.n.y() - a.n.y() * b.n.x();
    if (!(std::abs(det) > 0.05)) return std::nullopt;
    return Vector2d{(a.d * b.n.y() - b.d * a.n.y()) / det, (b.d * a.n.x() - a.d * b.n.x()) / det};
}

/// Measures the edge of a tag from its corner a to its corner b. On the way from a to b, the inside
/// of the tag is on the left in the picture. Returns a line in rays (x/z, y/z).
std::optional<Line> measureEdge(const Light& light, const CameraModel& camera, const Vector2d& a,
                                const Vector2d& b, const TagFamilyInfo& family) {
    const double length = (b - a).norm();
    const double reach = std::min(kMostReach, 0.75 * length / family.cells);
    if (!(reach > 0.8)) return std::nullopt;
    const Vector2d along = (b - a) / length;
    const Vector2d outwards{-along.y(), along.x()};
    const Vector2d brighter = family.brightInside ? Vector2d(-outwards) : outwards;
    const int count = std::clamp(static_cast<int>(length), 8, 48);
    std::vector<EdgePoint> points;
    points.reserve(count);
    for (int i = 0; i < count; ++i) {
        const double at = kEnds + (1 - 2 * kEnds) * (i + 0.5) / count;
        const auto step = findStep(light, a + at * length * along, brighter, reach);
        if (step) points.push_back({camera.unproject(step->pixel), step->weight});
    }
    if (points.size() * 2 < static_cast<std::size_t>(count)) return std::nullopt;
    return fitLine(std::move(points));
}

}  // namespace

CornerRefiner::CornerRefiner(double gamma) {
    if (!(gamma >= 0.2 && gamma <= 5))
        throw std::invalid_argument("corner refinement: gamma must be from 0.2 to 5");
    for (int i = 0; i < 256; ++i)
        light_[i] = std::pow(i / 255., gamma);
}

void CornerRefiner::refine(const ImageView& luma, const CameraModel& camera,
                           TagDetection& detection) const {
    const Light light(luma, light_);
    const TagFamilyInfo& family = info(detection.tag.family);
    const auto& corners = detection.corners;
    std::array<std::optional<Line>, 4> edges;
    for (int k = 0; k < 4; ++k) {
        edges[k] = measureEdge(light, camera, corners[k], corners[(k + 1) % 4], family);
        if (!edges[k]) return;
    }
    std::array<Vector2d, 4> refined;
    for (int k = 0; k < 4; ++k) {
        const auto ray = intersect(*edges[(k + 3) % 4], *edges[k]);
        if (!ray) return;
        refined[k] = camera.project(*ray);
        if (!((refined[k] - corners[k]).norm() < kFarthestMove)) return;
    }
    detection.corners = refined;
}

}  // namespace mfar
