#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace mfar {

/// Built-in shapes, centred at the origin of the object's frame.
enum class VirtualShape : unsigned {
    Box,
    Sphere,  ///< an ellipsoid if the sizes differ
    Quad,    ///< in the plane z = 0, visible from both sides; size z is ignored
};
inline constexpr std::size_t kVirtualShapes = 3;

/// A simple object in the world, for the preview and until path-traced pictures of the scene exist.
struct VirtualObject {
    VirtualShape shape = VirtualShape::Box;
    Eigen::Vector3d size{1, 1, 1};  ///< extent along x, y, z [m]
    RigidTransform T_world_object;
    /// Colours of a checkerboard on each of the six sides (a quad has one), in display values, RGB,
    /// [0, 1]. Equal colours: uniform.
    std::array<Eigen::Vector3f, 2> colours{Eigen::Vector3f{0.9F, 0.9F, 0.9F},
                                           Eigen::Vector3f{0.8F, 0.2F, 0.1F}};
    int squares = 4;  ///< along each side, at least 1
};

/// Triangles of a shape of extent 1 along each axis.
struct ShapeMesh {
    struct Vertex {
        Eigen::Vector3f position, normal;  ///< normal: outwards, unit length
        Eigen::Vector2f uv;                ///< [0, 1] over each side
    };
    std::vector<Vertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Each side has kShapeSegments^2 cells of two triangles: even if the side fills the picture of a
/// lens with k1 = -0.3, its edges are within 0.25 px (of 2304) of the exact curves. A sphere is the
/// projected box.
inline constexpr int kShapeSegments = 24;
[[nodiscard]] ShapeMesh shapeMesh(VirtualShape shape);

}  // namespace mfar
