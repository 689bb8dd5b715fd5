#include "pipeline/models/lathe.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mfar {
namespace {

constexpr float kFullTurn = 2 * std::numbers::pi_v<float>;
constexpr float kAxis = 1e-6F;

/// Returns the point of the spline at the fraction `share` between the second and the third knot.
/// Source: Barry, Goldman, A Recursive Evaluation Algorithm for a Class of Catmull-Rom Splines,
/// SIGGRAPH 1988.
Eigen::Vector2f splinePoint(const std::array<Eigen::Vector2f, 4>& knots, float share) {
    std::array<float, 4> at{};
    for (std::size_t i = 1; i < 4; ++i)
        at[i] = at[i - 1] + std::max(std::sqrt((knots[i] - knots[i - 1]).norm()), 1e-6F);
    const float t = std::lerp(at[1], at[2], share);
    std::array<Eigen::Vector2f, 4> p = knots;
    const auto mix = [&](std::size_t i, std::size_t from, std::size_t to) {
        p[i] = ((at[to] - t) * p[i] + (t - at[from]) * p[i + 1]) / (at[to] - at[from]);
    };
    for (std::size_t i = 0; i < 3; ++i)
        mix(i, i, i + 1);
    for (std::size_t i = 0; i < 2; ++i)
        mix(i, i, i + 2);
    mix(0, 1, 2);
    return p[0];
}

class Lathe {
public:
    Lathe(const LatheProfile& profile, const LatheOptions& options)
        : profile_(profile), options_(options) {}

    [[nodiscard]] Eigen::Vector3f point(float along, float angle) const {
        const Eigen::Vector2f p = profileAt(along);
        const float r = p.x() * (options_.shape ? options_.shape(angle, p.y()) : 1);
        return {options_.centre.x() + r * std::cos(angle),
                options_.centre.y() + r * std::sin(angle), p.y()};
    }
    [[nodiscard]] Eigen::Vector3f normal(float along, float angle) const {
        constexpr float kStep = 0.02F;
        const float last = static_cast<float>(profile_.size() - 1);
        const float low = std::max(along - kStep, 0.0F), high = std::min(along + kStep, last);
        const Eigen::Vector3f up = point(high, angle) - point(low, angle);
        const Eigen::Vector3f round = point(along, angle + kStep) - point(along, angle - kStep);
        const Eigen::Vector3f n = round.cross(up);
        if (n.norm() > 1e-12F) return n.normalized();
        // On the axis, the tangent around the axis is undefined, and the normal is vertical.
        return {0, 0, profileAt(high).x() > profileAt(low).x() ? -1.0F : 1.0F};
    }
    [[nodiscard]] bool onAxis(std::size_t row) const { return profile_[row].x() < kAxis; }

private:
    [[nodiscard]] Eigen::Vector2f profileAt(float along) const {
        const auto i = std::min(static_cast<std::size_t>(along), profile_.size() - 2);
        const float rest = along - static_cast<float>(i);
        return profile_[i] + rest * (profile_[i + 1] - profile_[i]);
    }

    const LatheProfile& profile_;
    const LatheOptions& options_;
};

}  // namespace

LatheProfile smoothProfile(const LatheProfile& knots, int count) {
    const auto last = static_cast<std::ptrdiff_t>(knots.size()) - 1;
    const auto knot = [&](std::ptrdiff_t i) -> Eigen::Vector2f {
        if (i < 0) return 2 * knots[0] - knots[1];
        if (i > last) return 2 * knots[last] - knots[last - 1];
        return knots[i];
    };
    LatheProfile out;
    for (int i = 0; i < count; ++i) {
        const float along = static_cast<float>(last) * static_cast<float>(i) / (count - 1);
        const auto segment = std::min(static_cast<std::ptrdiff_t>(along), last - 1);
        out.push_back(
            splinePoint({knot(segment - 1), knot(segment), knot(segment + 1), knot(segment + 2)},
                        along - static_cast<float>(segment)));
        out.back().x() = std::max(out.back().x(), 0.0F);
    }
    return out;
}

void addTurned(Mesh& mesh, const LatheProfile& profile, const LatheOptions& options) {
    const Lathe lathe(profile, options);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size()),
               row = static_cast<std::uint32_t>(options.around) + 1;
    float length = 0;
    std::vector<float> lengths = {0};
    for (std::size_t j = 1; j < profile.size(); ++j)
        lengths.push_back(length += (profile[j] - profile[j - 1]).norm());
    for (std::size_t j = 0; j < profile.size(); ++j) {
        const float v = std::lerp(options.vBottom, options.vTop, lengths[j] / length);
        for (int i = 0; i <= options.around; ++i) {
            const float u = static_cast<float>(i) / static_cast<float>(options.around);
            mesh.positions.push_back(lathe.point(static_cast<float>(j), u * kFullTurn));
            mesh.normals.push_back(lathe.normal(static_cast<float>(j), u * kFullTurn));
            mesh.uvs.emplace_back(u, v);
        }
    }
    for (std::uint32_t j = 0; j + 1 < profile.size(); ++j) {
        for (std::uint32_t i = 0; i + 1 < row; ++i) {
            const std::uint32_t a = first + j * row + i;
            if (!lathe.onAxis(j)) mesh.triangles.push_back({a, a + 1, a + row + 1});
            if (!lathe.onAxis(j + 1)) mesh.triangles.push_back({a, a + row + 1, a + row});
        }
    }
}

}  // namespace mfar
