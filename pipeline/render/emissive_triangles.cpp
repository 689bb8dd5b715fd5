#include "pipeline/render/emissive_triangles.h"

#include "base/luminance.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mfar {
namespace {

// The mean emission of a textured triangle is computed from about four points per texel, and from
// at most kMostSteps^2 points.
constexpr int kMostSteps = 32;
// A sample's ray ends behind the sampled point, at the point's distance times this factor. If it
// ended at the point, rounding errors could make it end before it hits the triangle.
constexpr float kBehind = 1.001F;
constexpr double kLastBit = 0x1p-24;  // smallest difference of two numbers of PixelSampler

double areaOf(const std::array<Eigen::Vector3f, 3>& corners) {
    const Eigen::Vector3d a = corners[0].cast<double>();
    return 0.5 * (corners[1].cast<double>() - a).cross(corners[2].cast<double>() - a).norm();
}

/// Maps two random numbers uniformly to weights of the second and third corners (Heitz 2019).
Eigen::Vector2f cornerWeights(Eigen::Vector2f u) {
    if (u.y() > u.x()) {
        u.x() *= 0.5F;
        u.y() -= u.x();
    } else {
        u.y() *= 0.5F;
        u.x() -= u.y();
    }
    return u;
}

/// Returns the Morton code of a point of the box: the cells of a grid of 1024^3 are numbered along
/// a curve that stays in each octant until it has passed all of its cells.
std::uint32_t placeOnCurve(const Eigen::Vector3f& point, const Eigen::AlignedBox3f& box) {
    constexpr float kCells = 1024;
    constexpr int kBits = 10;
    std::uint32_t out = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float share = (point[axis] - box.min()[axis]) / box.sizes()[axis];
        const auto cell =
            static_cast<std::uint32_t>(share > 0 ? std::min(share * kCells, kCells - 1) : 0);
        for (int bit = 0; bit < kBits; ++bit)
            out |= (cell >> bit & 1U) << (3 * bit + axis);
    }
    return out;
}

double meanLuminance(const TracedScene& scene, std::uint32_t mesh, std::uint32_t triangle) {
    const float texels = scene.emissionTexels(mesh, triangle);
    const int steps = static_cast<int>(
        std::clamp(std::ceil(2 * std::sqrt(texels)), 1.0F, static_cast<float>(kMostSteps)));
    const auto step = static_cast<float>(steps);
    double sum = 0;
    for (int y = 0; y < steps; ++y)
        for (int x = 0; x < steps; ++x) {
            const Eigen::Vector2f at = cornerWeights(
                {(static_cast<float>(x) + 0.5F) / step, (static_cast<float>(y) + 0.5F) / step});
            const RayHit point{0, mesh, triangle, at.x(), at.y()};
            sum += luminanceOf<double>(scene.emission(point).cast<double>());
        }
    return sum / (steps * steps);
}

}  // namespace

struct EmissiveTriangles::Weighed {
    Triangle triangle;
    std::uint32_t place;  ///< Morton code of its position, see placeOnCurve()
    double luminance, power;
};

// The triangles are sorted along a curve through space. Then similar random numbers select
// triangles that are near each other.
EmissiveTriangles::EmissiveTriangles(const TracedScene& scene)
    : scene_(&scene), densities_(scene.meshes()) {
    const Eigen::AlignedBox3f& box = scene.objects().box();
    std::vector<Weighed> found;
    double sum = 0;
    for (std::uint32_t mesh = 0; mesh < scene.meshes(); ++mesh) {
        if (!scene.emits(mesh)) continue;
        densities_[mesh].resize(scene.triangles(mesh));
        for (std::uint32_t i = 0; i < densities_[mesh].size(); ++i) {
            const auto corners = scene.corners(mesh, i);
            const double luminance = meanLuminance(scene, mesh, i);
            const double power = areaOf(corners) * luminance;
            if (!(power > 0 && std::isfinite(power))) continue;
            found.push_back({{mesh, i},
                             placeOnCurve((corners[0] + corners[1] + corners[2]) / 3, box),
                             luminance,
                             power});
            sum += power;
        }
    }
    std::ranges::sort(found, {}, [](const Weighed& t) {
        return std::tuple(t.place, t.triangle.mesh, t.triangle.index);
    });
    std::vector<double> powers;
    for (const Weighed& t : found) {
        triangles_.push_back(t.triangle);
        powers.push_back(t.power);
        densities_[t.triangle.mesh][t.triangle.index] = static_cast<float>(t.luminance / sum);
    }
    table_ = ShareTable(powers);
}

EmissiveTriangles::EmissiveTriangles(const EmissiveTriangles& other, const TracedScene& posed)
    : EmissiveTriangles(other) {
    scene_ = &posed;
}

EmissiveTriangles::Sample EmissiveTriangles::sample(const Eigen::Vector3f& from,
                                                    const Eigen::Vector2f& u, float fine) const {
    const auto [index, rest] = table_.draw(static_cast<double>(u.x()) + kLastBit * fine);
    const Triangle& drawn = triangles_[index];
    const auto [a, b, c] = scene_->corners(drawn.mesh, drawn.index);
    const Eigen::Vector2f weights = cornerWeights({rest, u.y()});
    const Eigen::Vector3f way = a + weights.x() * (b - a) + weights.y() * (c - a) - from;
    const float distance = way.norm();
    if (!(distance > 0 && std::isfinite(distance))) return {};
    const Eigen::Vector3f direction = way / distance;
    if (scene_->isSingleSided(drawn.mesh) && (b - a).cross(c - a).dot(direction) > 0) return {};
    return {{from, direction, 0, kBehind * distance},
            {distance, drawn.mesh, drawn.index, weights.x(), weights.y()},
            density(drawn, direction, distance)};
}

float EmissiveTriangles::density(const Ray& ray, const RayHit& hit) const {
    return densities_[hit.mesh].empty() ? 0
                                        : density({hit.mesh, hit.triangle}, ray.direction, hit.t);
}

// Returns the probability density of sampling this direction, per solid angle. For a triangle seen
// edge-on it would be infinite; 0 is returned then.
float EmissiveTriangles::density(const Triangle& triangle, const Eigen::Vector3f& direction,
                                 float distance) const {
    const auto [a, b, c] = scene_->corners(triangle.mesh, triangle.index);
    const Eigen::Vector3d normal =
        (b - a).cast<double>().cross((c - a).cast<double>()).normalized();
    const double cosine = std::abs(normal.dot(direction.cast<double>()));
    const auto out = static_cast<float>(densities_[triangle.mesh][triangle.index] *
                                        static_cast<double>(distance) * distance / cosine);
    return std::isfinite(out) ? out : 0;
}

}  // namespace mfar
