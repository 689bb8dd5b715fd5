#pragma once

#include "hal/virtual/synthetic_scene.h"

#include <array>
#include <cstdint>

namespace mfar::synthetic {

/// Assembles a world. Positions [m] in the world, angles [rad] about the world's z axis.
class Builder {
public:
    World world;

    /// Adds a material and returns its index.
    int material(const Material& m);
    /// Material whose texture fills a face of this size once, for +x, -y and +z faces.
    int sheet(Layer layer, double width, double height, const Eigen::Vector3d& tint,
              double gloss = 0);
    /// A material that repeats `perMetre` times.
    int tiled(Layer layer, double perMetre, const Eigen::Vector3d& tint, double variation = 0.15,
              double gloss = 0);

    Primitive& box(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, double yaw,
                   std::array<int, 3> materials);
    Primitive& box(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, double yaw, int m) {
        return box(centre, size, yaw, {m, m, m});
    }
    /// Upright cylinder.
    Primitive& cylinder(const Eigen::Vector3d& centre, double radius, double height, int side,
                        int caps);
    /// Cylinder between two points.
    Primitive& rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, int m);
    Primitive& ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii, double yaw,
                         int m);
    /// A plate with tag `id` (0..3), its black square `size` wide, standing and facing -y (turned
    /// by yaw), or lying and facing up.
    void standingTag(int id, const Eigen::Vector3d& centre, double size, double yaw);
    void lyingTag(int id, const Eigen::Vector3d& centre, double size, double yaw);
    /// A lying book with its cover on top, or a standing one with its spine to -y.
    void lyingBook(const Eigen::Vector3d& bottom, const Eigen::Vector3d& size, double yaw,
                   const Eigen::Vector3d& tint);
    void standingBook(const Eigen::Vector3d& bottom, const Eigen::Vector3d& size, double yaw,
                      const Eigen::Vector3d& tint);

private:
    int tagMaterial(int id, double plate);
};

[[nodiscard]] World makeOffice(std::uint64_t seed, bool withMover);
[[nodiscard]] World makeShelf(std::uint64_t seed);
[[nodiscard]] World makeOutdoor(std::uint64_t seed);
[[nodiscard]] World makeFlat(std::uint64_t seed);
[[nodiscard]] World makeCalibration();

}  // namespace mfar::synthetic
