#pragma once

#include "hal/virtual/synthetic_scene.h"

#include <optional>
#include <span>
#include <vector>

namespace mfar::synthetic {

struct Ray {
    Eigen::Vector3d origin;
    Eigen::Vector3d direction;  ///< its length is the unit of distances along the ray
};

/// The solids of a world at one time, for ray casting in double precision. Thread-safe, because it
/// does not change after construction.
class Snapshot {
public:
    Snapshot(const World& world, double t);

    /// Returns the nearest hit with a distance in (0, limit), or nothing. The overloads with
    /// `among` test only the solids with these indices, which must be in ascending order.
    [[nodiscard]] std::optional<Hit> cast(const Ray& ray, double limit) const;
    [[nodiscard]] bool blocked(const Ray& ray, double limit, int except) const;
    [[nodiscard]] std::optional<Hit> cast(const Ray& ray, double limit,
                                          std::span<const int> among) const;
    [[nodiscard]] bool blocked(const Ray& ray, double limit, int except,
                               std::span<const int> among) const;
    [[nodiscard]] double radius(int primitive) const { return solids_[primitive].radius; }
    [[nodiscard]] const RigidTransform& pose(int primitive) const {
        return solids_[primitive].T_world_prim;
    }
    [[nodiscard]] int size() const { return static_cast<int>(solids_.size()); }

private:
    struct Solid {
        Shape shape;
        RigidTransform T_world_prim;
        Eigen::Matrix3d toUnit;  ///< world direction -> primitive's frame, where half extents are 1
        Eigen::Vector3d half;
        double radius;
    };
    std::vector<Solid> solids_;
    std::vector<int> all_;
};

}  // namespace mfar::synthetic
