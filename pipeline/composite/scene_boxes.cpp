#include "pipeline/composite/scene_boxes.h"

#include "base/se3.h"
#include "pipeline/scene/scene_parts.h"

#include <algorithm>
#include <array>
#include <span>
#include <unordered_map>
#include <utility>

namespace mfar {
namespace {

// Number of cells of an object's bounding box along each axis. It gives about 150 boxes around the
// object's surface.
constexpr int kCells = 6;
// Edges of a box are projected in this number of pieces, because the lens bends straight edges.
constexpr int kEdgePieces = 4;

using Triangle = std::array<std::uint32_t, 3>;

/// Divides a bounding box into cells and computes a smaller box for each cell: the bounds of all
/// triangles whose centre is in this cell.
class CellBoxes {
public:
    explicit CellBoxes(const Eigen::AlignedBox3d& all) : all_(all) {}

    void add(const std::array<Eigen::Vector3d, 3>& corners) {
        const Eigen::Vector3d centre = (corners[0] + corners[1] + corners[2]) / 3;
        const Eigen::Array3d extent = all_.sizes().array().max(1e-9);
        const Eigen::Array3i cell =
            ((centre - all_.min()).array() / extent * kCells).cast<int>().max(0).min(kCells - 1);
        Eigen::AlignedBox3d& box = cells_[(cell.z() * kCells + cell.y()) * kCells + cell.x()];
        for (const Eigen::Vector3d& corner : corners)
            box.extend(corner);
    }
    void appendTo(std::vector<Eigen::AlignedBox3d>& boxes) const {
        for (const auto& [cell, box] : cells_)
            boxes.push_back(box);
    }

private:
    Eigen::AlignedBox3d all_;
    std::unordered_map<int, Eigen::AlignedBox3d> cells_;
};

struct Surface {
    std::span<const Eigen::Vector3f> positions;
    std::span<const Triangle> triangles;
    RigidTransform T_world_surface;
    double scale = 1;

    [[nodiscard]] Eigen::Vector3d at(std::uint32_t vertex) const {
        return T_world_surface * (scale * positions[vertex].cast<double>());
    }
};

void appendBoxes(std::span<const Surface> surfaces, std::vector<Eigen::AlignedBox3d>& boxes) {
    Eigen::AlignedBox3d all;
    for (const Surface& s : surfaces)
        for (const Triangle& t : s.triangles)
            for (const std::uint32_t vertex : t)
                all.extend(s.at(vertex));
    if (all.isEmpty()) return;
    CellBoxes cells(all);
    for (const Surface& s : surfaces)
        for (const Triangle& t : s.triangles)
            cells.add({s.at(t[0]), s.at(t[1]), s.at(t[2])});
    cells.appendTo(boxes);
}

Eigen::Vector3d cornerOf(const Eigen::AlignedBox3d& box, int i) {
    return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
}

SurfaceExtent extentOf(const Eigen::AlignedBox3d& box, const LensProjection& lens,
                       const RigidTransform& T_video_box) {
    SurfaceExtent extent;
    for (int axis = 0; axis < 3; ++axis) {
        for (int from = 0; from < 8; ++from) {
            if ((from >> axis) & 1) continue;
            const Eigen::Vector3d a = T_video_box * cornerOf(box, from);
            const Eigen::Vector3d b = T_video_box * cornerOf(box, from | (1 << axis));
            Eigen::Vector3d last = lens(a);
            for (int i = 1; i <= kEdgePieces; ++i) {
                const Eigen::Vector3d next = lens(a + (b - a) * i / kEdgePieces);
                extent.extendBySegment(last, next);
                last = next;
            }
        }
    }
    return extent;
}

}  // namespace

SceneBoxes::SceneBoxes(const Scene& scene) {
    std::size_t count = 0;
    for (const SceneObject& object : scene.objects) {
        const RigidTransform T = object.path ? RigidTransform{} : object.T_world_object;
        std::vector<Surface> surfaces;
        for (const Mesh& mesh : meshesOf(object))
            surfaces.push_back({mesh.positions, mesh.triangles, T, object.scale});
        std::vector<Eigen::AlignedBox3d> moving;
        appendBoxes(surfaces, object.path ? moving : boxes_);
        count += moving.size();
        if (!moving.empty())
            moving_.push_back({object.path, object.T_world_object, std::move(moving)});
    }
    extents_.reserve(boxes_.size() + count);
}

void SceneBoxes::setTime(Timestamp time) {
    for (Moving& object : moving_)
        object.T_world_object = object.path->at(time.seconds());
}

SceneBoxes::SceneBoxes(const ShadowCatcher& catcher) {
    appendBoxes(std::array{Surface{catcher.positions, catcher.triangles, {}}}, boxes_);
    extents_.reserve(boxes_.size());
}

void SceneBoxes::addExtents(const std::vector<Eigen::AlignedBox3d>& boxes,
                            const LensProjection& lens, const RigidTransform& T_video_boxes) {
    for (const Eigen::AlignedBox3d& box : boxes) {
        const SurfaceExtent extent = extentOf(box, lens, T_video_boxes);
        if (!extent.pixels.isEmpty()) extents_.push_back(extent);
    }
}

const std::vector<SurfaceExtent>& SceneBoxes::extents(const LensProjection& lens,
                                                      const RigidTransform& T_world_video) {
    extents_.clear();
    if (!isFinite(T_world_video)) return extents_;
    const RigidTransform T_video_world = T_world_video.inverse();
    addExtents(boxes_, lens, T_video_world);
    for (const Moving& object : moving_)
        addExtents(object.boxes, lens, T_video_world * object.T_world_object);
    return extents_;
}

}  // namespace mfar
