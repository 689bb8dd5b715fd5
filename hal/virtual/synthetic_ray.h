#pragma once

#include "hal/virtual/synthetic_scene.h"

#include <optional>
#include <span>
#include <vector>

namespace mfar::synthetic {

struct Ray {
    Eigen::Vector3d origin;
    Eigen::Vector3d direction;  ///< any length; distances are in units of it
};

/// The solids of a world at one instant, for ray queries in double precision. Immutable after
/// construction, so any number of threads may use it.
class Snapshot {
public:
    Snapshot(const World& world, double t);

    /// Nearest hit with distance in (0, limit).
    [[nodiscard]] std::optional<Hit> cast(const Ray& ray, double limit) const;
    /// True when any solid but `except` is on the ray before `limit`.
    [[nodiscard]] bool blocked(const Ray& ray, double limit, int except) const;
    /// As cast() above, restricted to some primitives, in ascending order.
    [[nodiscard]] std::optional<Hit> cast(const Ray& ray, double limit,
                                          std::span<const int> among) const;
    [[nodiscard]] bool blocked(const Ray& ray, double limit, int except,
                               std::span<const int> among) const;
    /// Radius of the bounding sphere around pose(primitive).translation.
    [[nodiscard]] double radius(int primitive) const { return solids_[primitive].radius; }
    [[nodiscard]] const RigidTransform& pose(int primitive) const {
        return solids_[primitive].T_world_prim;
    }
    [[nodiscard]] int size() const { return static_cast<int>(solids_.size()); }

private:
    struct Solid {
        Shape shape;
        RigidTransform T_world_prim;
        Eigen::Matrix3d toUnit;  ///< world direction -> primitive frame scaled to half extents 1
        Eigen::Vector3d half;
        double radius;  ///< radius of the bounding sphere
    };
    std::vector<Solid> solids_;
    std::vector<int> all_;  ///< indices
};

}  // namespace mfar::synthetic
