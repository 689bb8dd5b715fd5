#include "pipeline/composite/shadow_catcher.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mfar {
namespace {

constexpr int kPlaneCells = 8;
// Distance between vertices [video px]. A finer grid would only show the noise of the depth.
constexpr int kStep = 4;
// Two neighbouring vertices are on different surfaces if their depths differ by at least this
// fraction of the smaller depth.
constexpr double kJump = 0.04;
// A surface within this distance of the tags' plane [m] counts as the plane, because the tags'
// paper has a thickness and waves.
constexpr double kPlaneSlack = 0.004;

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
                const RigidTransform& T_world_video)
        : field_(field), video_(video), eye_(T_world_video) {}

    /// Returns z [m], or 0 if z is unknown or too large for a surface near an object.
    [[nodiscard]] double depth(int x, int y) const {
        const std::size_t i = pixel(x, y);
        return field_.isKnown(i) && field_.inverseDepth[i] > 1e-3F
                   ? 1 / static_cast<double>(field_.inverseDepth[i])
                   : 0;
    }
    [[nodiscard]] Eigen::Vector3d point(int x, int y) const {
        const double z = depth(x, y);
        const Eigen::Vector2d ray = video_.unproject({x, y});
        const Eigen::Vector3d direction = eye_.rotation * ray.homogeneous();
        const Eigen::Vector3d& eye = eye_.translation;
        Eigen::Vector3d p = eye + z * direction;
        if (!(std::abs(direction.z()) > 1e-6)) return p;
        const double zOnPlane = -eye.z() / direction.z();
        const double sigma = z * z * std::sqrt(static_cast<double>(field_.variance[pixel(x, y)]));
        const bool isPlane = std::abs(zOnPlane - z) < 3 * sigma || std::abs(p.z()) < kPlaneSlack;
        return isPlane && zOnPlane > 0 ? eye + zOnPlane * direction : p;
    }

private:
    [[nodiscard]] std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * field_.size.width + x;
    }

    const InverseDepthField& field_;
    const CameraModel& video_;
    const RigidTransform& eye_;
};

}  // namespace

Eigen::AlignedBox3d boundsOf(const Scene& scene) {
    Eigen::AlignedBox3d box;
    for (const SceneObject& object : scene.objects)
        for (const Mesh& mesh : object.model->meshes)
            for (const Eigen::Vector3f& p : mesh.positions)
                box.extend(object.T_world_object * (object.scale * p).cast<double>());
    return box;
}

ShadowCatcher planeCatcher(const Eigen::AlignedBox3d& objects) {
    if (objects.isEmpty()) return {};
    const double reach = kShadowReach * radiusOf(objects);
    if (objects.max().z() < 0 || objects.min().z() > reach || !(reach > 0)) return {};
    const Eigen::Vector2d low = objects.min().head<2>().array() - reach;
    const Eigen::Vector2d high = objects.max().head<2>().array() + reach;
    Grid grid(kPlaneCells + 1, kPlaneCells + 1);
    for (int y = 0; y <= kPlaneCells; ++y) {
        for (int x = 0; x <= kPlaneCells; ++x) {
            const Eigen::Array2d share = Eigen::Array2d(x, y) / kPlaneCells;
            const Eigen::Vector2d p = low.array() + share * (high - low).array();
            grid.set(x, y, {p.x(), p.y(), 0});
        }
    }
    for (int y = 0; y < kPlaneCells; ++y)
        for (int x = 0; x < kPlaneCells; ++x)
            grid.addCell(x, y);
    return grid.take();
}

ShadowCatcher depthCatcher(const InverseDepthField& field, const CameraModel& video,
                           const RigidTransform& T_world_video, const PixelRect& where,
                           const Eigen::AlignedBox3d& objects) {
    const PixelRect area = common(where, {0, 0, field.size.width, field.size.height});
    if (area.empty() || objects.isEmpty()) return {};
    const double reach = kShadowReach * radiusOf(objects);
    const Eigen::AlignedBox3d near(objects.min().array() - reach, objects.max().array() + reach);
    const int columns = (area.x1 - area.x0 + kStep - 1) / kStep;
    const int rows = (area.y1 - area.y0 + kStep - 1) / kStep;
    const SeenSurface surface(field, video, T_world_video);
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

}  // namespace mfar
