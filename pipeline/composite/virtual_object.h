#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace mfar {

/// Built-in shapes, centred at the origin of the object's coordinates.
enum class VirtualShape : unsigned {
    Box,
    Sphere,
    Quad,  ///< in the plane z = 0, visible from both sides; size z is ignored
};
inline constexpr std::size_t kVirtualShapes = 3;

/// A virtual object of simple shape. The preview rasterises it; the path tracer uses its triangles.
struct VirtualObject {
    VirtualShape shape = VirtualShape::Box;
    Eigen::Vector3d size{1, 1, 1};  ///< extent along x, y, z [m]
    RigidTransform T_world_object;
    /// The two colours of the checkerboard on each side, as RGB display values in [0, 1]. Equal
    /// colours give a uniform side.
    std::array<Eigen::Vector3f, 2> colours{Eigen::Vector3f{0.9F, 0.9F, 0.9F},
                                           Eigen::Vector3f{0.8F, 0.2F, 0.1F}};
    int squares = 4;  ///< squares of the checkerboard along each axis of a side, at least 1

    bool operator==(const VirtualObject&) const = default;
};

struct ShapeMesh {
    struct Vertex {
        Eigen::Vector3f position, normal;  ///< the normal is a unit vector that points outwards
        Eigen::Vector2f uv;
    };
    std::vector<Vertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Each side has kShapeSegments^2 cells of two triangles. Even if the side fills a picture of 2304
/// px width and the lens has k1 = -0.3, the cells' edges deviate from the exact curves by at most
/// 0.25 px.
inline constexpr int kShapeSegments = 24;
[[nodiscard]] ShapeMesh shapeMesh(VirtualShape shape);

}  // namespace mfar
