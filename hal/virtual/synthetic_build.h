#pragma once

#include "hal/virtual/synthetic_scene.h"

#include <array>
#include <cstdint>

namespace mfar::synthetic {

/// Assembles a world from solids. Positions and sizes are in metres, in the world's frame. Yaw
/// angles [rad] are about the world's z axis. Materials are given by the index that material(),
/// sheet() or tiled() returned.
class Builder {
public:
    World world;

    int material(const Material& m);
    /// Adds a material whose texture fills a face of this size exactly once. It suits the +x, -y
    /// and +z faces of a box; on the opposite faces, the texture is mirrored.
    int sheet(Layer layer, double width, double height, const Eigen::Vector3d& tint,
              double gloss = 0);
    /// Adds a material whose texture repeats `perMetre` times per metre.
    int tiled(Layer layer, double perMetre, const Eigen::Vector3d& tint, double variation = 0.15,
              double gloss = 0);

    Primitive& box(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, double yaw,
                   std::array<int, 3> materials);
    Primitive& box(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, double yaw, int m) {
        return box(centre, size, yaw, {m, m, m});
    }
    Primitive& cylinder(const Eigen::Vector3d& centre, double radius, double height, int side,
                        int caps);
    Primitive& rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, int m);
    Primitive& ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii, double yaw,
                         int m);
    /// Adds a plate with tag `id` (0..3), whose black square has the side `size`. A standing tag
    /// faces -y, rotated by yaw. A lying tag faces up.
    void standingTag(int id, const Eigen::Vector3d& centre, double size, double yaw);
    void lyingTag(int id, const Eigen::Vector3d& centre, double size, double yaw);
    /// A lying book has its cover on top. A standing book has its spine towards -y.
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
