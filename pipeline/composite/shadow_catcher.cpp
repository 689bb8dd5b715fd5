#include "pipeline/composite/shadow_catcher.h"

#include "pipeline/composite/lens_projection.h"
#include "pipeline/scene/glow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mfar {
namespace {

// Planes beside a measured surface have small triangles, so that the gap to the surface is small.
constexpr int kUnseenCells = 32;
// Distance between vertices [video px]. A finer grid would only show the noise of the depth.
constexpr int kStep = 4;
// Two neighbouring vertices are on different surfaces if their depths differ by at least this
// fraction of the smaller depth.
constexpr double kJump = 0.04;
// A surface within this distance of the tags' plane [m] counts as part of the plane, because the
// tags' paper is not flat and has a thickness.
constexpr double kPlaneSlack = 0.004;
// Tags that lie on the same surface have planes that differ by up to this distance [m], because
// their poses have errors.
constexpr double kSamePlane = 0.01;

double radiusOf(const Eigen::AlignedBox3d& box) {
    return 0.5 * box.diagonal().norm();
}

class Grid {
public:
    Grid(int columns, int rows)
        : columns_(columns), index_(static_cast<std::size_t>(columns) * rows, -1) {}

    void set(int column, int row, const Eigen::Vector3d& p) {
        at(column, row) = static_cast<int>(out_.positions.size());
        out_.positions.push_back(p.cast<float>());
    }
    void addCell(int column, int row) {
        const int a = at(column, row), b = at(column + 1, row);
        const int c = at(column, row + 1), d = at(column + 1, row + 1);
        if (std::min({a, b, c, d}) < 0) return;
        addTriangle(a, b, c);
        addTriangle(b, d, c);
    }
    [[nodiscard]] ShadowCatcher take() { return std::move(out_); }

private:
    int& at(int column, int row) {
        return index_[static_cast<std::size_t>(row) * columns_ + column];
    }
    void addTriangle(int a, int b, int c) {
        out_.triangles.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                  static_cast<std::uint32_t>(c)});
    }

    int columns_;
    std::vector<int> index_;
    ShadowCatcher out_;
};

class SeenSurface {
public:
    SeenSurface(const InverseDepthField& field, const CameraModel& video,
                const RigidTransform& T_world_video, std::span<const GroundPlane> planes)
        : field_(field), video_(video), eye_(T_world_video) {
        for (const GroundPlane& plane : planes)
            planes_.emplace_back(plane.T_world_plane.rotation * Eigen::Vector3d::UnitZ(),
                                 plane.T_world_plane.translation);
    }

    /// Returns z [m], or 0 if z is unknown or too large for a surface near an object.
    [[nodiscard]] double depth(int x, int y) const {
        const std::size_t i = pixel(x, y);
        return field_.isKnown(i) && field_.inverseDepth[i] > 1e-3F
                   ? 1 / static_cast<double>(field_.inverseDepth[i])
                   : 0;
    }
    /// Returns the measured point, moved onto the nearest plane from which it cannot be
    /// distinguished.
    [[nodiscard]] Eigen::Vector3d point(int x, int y) const {
        const double z = depth(x, y);
        const Eigen::Vector2d ray = video_.unproject({x, y});
        const Eigen::Vector3d direction = eye_.rotation * ray.homogeneous();
        const Eigen::Vector3d& eye = eye_.translation;
        const Eigen::Vector3d measured = eye + z * direction;
        Eigen::Vector3d p = measured;
        const double sigma = z * z * std::sqrt(static_cast<double>(field_.variance[pixel(x, y)]));
        double off = std::numeric_limits<double>::infinity();
        for (const Plane& plane : planes_) {
            const double fall = -plane.normal().dot(direction);
            if (!(std::abs(fall) > 1e-6)) continue;
            const double zOnPlane = plane.signedDistance(eye) / fall, away = std::abs(zOnPlane - z);
            if (!(zOnPlane > 0 && away < off)) continue;
            if (away >= 3 * sigma && plane.absDistance(measured) >= kPlaneSlack) continue;
            off = away;
            p = eye + zOnPlane * direction;
        }
        return p;
    }

private:
    [[nodiscard]] std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * field_.size.width + x;
    }

    using Plane = Eigen::Hyperplane<double, 3>;

    const InverseDepthField& field_;
    const CameraModel& video_;
    const RigidTransform& eye_;
    std::vector<Plane> planes_;
};

/// True if the ground hardly differs from the plane below and around the objects. `objects` are the
/// objects' bounds in the ground's frame.
bool isSamePlane(const RigidTransform& T_plane_ground, const Eigen::AlignedBox3d& objects) {
    const double reach = kShadowReach * radiusOf(objects);
    for (const auto corner : {objects.BottomLeftFloor, objects.BottomRightFloor,
                              objects.TopLeftFloor, objects.TopRightFloor}) {
        Eigen::Vector3d p = objects.corner(corner);
        p += reach * (p - objects.center()).cwiseSign();
        p.z() = 0;
        if (!(std::abs((T_plane_ground * p).z()) < kSamePlane)) return false;
    }
    return true;
}

}  // namespace

std::vector<GroundPlane> groundPlanes(const Scene& scene) {
    const double reach = glowReach(scene) * kShadowReach;
    std::vector<GroundPlane> out{{{}, boundsOf(scene), reach}};
    for (const SceneObject& object : scene.objects) {
        const RigidTransform T_ground_world = object.T_world_ground.inverse();
        const Eigen::AlignedBox3d objects = boundsIn(T_ground_world, object);
        if (objects.isEmpty()) continue;
        const auto same = std::ranges::find_if(out, [&](const GroundPlane& plane) {
            return isSamePlane(plane.T_world_plane.inverse() * object.T_world_ground, objects);
        });
        if (same == out.end())
            out.push_back({object.T_world_ground, objects, reach});
        else if (same != out.begin())
            same->objects.extend(boundsIn(same->T_world_plane.inverse(), object));
    }
    return out;
}

ShadowCatcher planeCatcher(const Eigen::AlignedBox3d& objects, double reachInRadii, int cells) {
    if (objects.isEmpty()) return {};
    const double reach = reachInRadii * radiusOf(objects);
    if (objects.max().z() < 0 || objects.min().z() > reach || !(reach > 0)) return {};
    const Eigen::Vector2d low = objects.min().head<2>().array() - reach;
    const Eigen::Vector2d high = objects.max().head<2>().array() + reach;
    Grid grid(cells + 1, cells + 1);
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            const Eigen::Array2d share = Eigen::Array2d(x, y) / cells;
            const Eigen::Vector2d p = low.array() + share * (high - low).array();
            grid.set(x, y, {p.x(), p.y(), 0});
        }
    }
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x)
            grid.addCell(x, y);
    return grid.take();
}

ShadowCatcher planeCatcher(std::span<const GroundPlane> planes, int cells) {
    ShadowCatcher out;
    for (const GroundPlane& plane : planes) {
        const auto first = static_cast<std::uint32_t>(out.positions.size());
        const ShadowCatcher part = planeCatcher(plane.objects, plane.reach, cells);
        for (const Eigen::Vector3f& p : part.positions)
            out.positions.emplace_back((plane.T_world_plane * p.cast<double>()).cast<float>());
        for (const auto& t : part.triangles)
            out.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return out;
}

ShadowCatcher depthCatcher(const InverseDepthField& field, const CameraModel& video,
                           const RigidTransform& T_world_video, const PixelRect& where,
                           std::span<const GroundPlane> planes) {
    if (planes.empty()) return {};
    const Eigen::AlignedBox3d& objects = planes.front().objects;
    const PixelRect area = common(where, {0, 0, field.size.width, field.size.height});
    if (area.empty() || objects.isEmpty()) return {};
    const double reach = planes.front().reach * radiusOf(objects);
    const Eigen::AlignedBox3d near(objects.min().array() - reach, objects.max().array() + reach);
    const int columns = (area.x1 - area.x0 + kStep - 1) / kStep;
    const int rows = (area.y1 - area.y0 + kStep - 1) / kStep;
    const SeenSurface surface(field, video, T_world_video, planes);
    const auto x = [&](int column) { return area.x0 + column * kStep; };
    const auto y = [&](int row) { return area.y0 + row * kStep; };
    Grid grid(columns, rows);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            if (!(surface.depth(x(column), y(row)) > 0)) continue;
            const Eigen::Vector3d p = surface.point(x(column), y(row));
            if (near.contains(p)) grid.set(column, row, p);
        }
    }
    for (int row = 0; row + 1 < rows; ++row) {
        for (int column = 0; column + 1 < columns; ++column) {
            const auto [least, most] = std::minmax(
                {surface.depth(x(column), y(row)), surface.depth(x(column + 1), y(row)),
                 surface.depth(x(column), y(row + 1)), surface.depth(x(column + 1), y(row + 1))});
            if (most - least < kJump * least) grid.addCell(column, row);
        }
    }
    return grid.take();
}

void addUnseen(ShadowCatcher& measured, std::span<const GroundPlane> planes,
               const CameraModel& video, const RigidTransform& T_world_video) {
    const ShadowCatcher all = planeCatcher(planes, kUnseenCells);
    const RigidTransform T_video_world = T_world_video.inverse();
    const LensProjection lens(video);
    std::vector<bool> seen;
    for (const Eigen::Vector3f& position : all.positions) {
        const Eigen::Vector3d p = lens(T_video_world * position.cast<double>());
        seen.push_back(p.z() > 0 && p.x() >= 0 && p.y() >= 0 && p.x() < p.z() * video.size.width &&
                       p.y() < p.z() * video.size.height);
    }
    const auto first = static_cast<std::uint32_t>(measured.positions.size());
    const std::size_t before = measured.triangles.size();
    for (const auto& t : all.triangles)
        if (!seen[t[0]] && !seen[t[1]] && !seen[t[2]])
            measured.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    if (measured.triangles.size() > before)
        measured.positions.insert(measured.positions.end(), all.positions.begin(),
                                  all.positions.end());
}

}  // namespace mfar
