#include "pipeline/composite/virtual_object.h"

#include <cmath>
#include <numbers>

namespace mfar {
namespace {

struct Side {
    Eigen::Vector3f normal, u, v;
};

void addSide(ShapeMesh& mesh, const Side& side, bool round, float offset) {
    constexpr auto kRow = static_cast<std::uint32_t>(kShapeSegments + 1);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto along = [&](int i) {
        const float t = 2.0F * static_cast<float>(i) / kShapeSegments - 1;
        // On a sphere, steps of equal angle give cells of more similar size than steps of equal
        // length.
        return round ? std::tan(t * std::numbers::pi_v<float> / 4) : t;
    };
    for (int j = 0; j <= kShapeSegments; ++j) {
        for (int i = 0; i <= kShapeSegments; ++i) {
            const Eigen::Vector3f p = side.normal * offset + along(i) * side.u + along(j) * side.v;
            const Eigen::Vector2f uv(static_cast<float>(i), static_cast<float>(j));
            mesh.vertices.push_back({0.5F * (round ? p.normalized() : p),
                                     round ? p.normalized() : side.normal, uv / kShapeSegments});
        }
    }
    for (std::uint32_t j = 0; j + 1 < kRow; ++j) {
        for (std::uint32_t i = 0; i + 1 < kRow; ++i) {
            const std::uint32_t a = first + j * kRow + i;
            mesh.triangles.push_back({a, a + 1, a + kRow});
            mesh.triangles.push_back({a + 1, a + kRow + 1, a + kRow});
        }
    }
}

}  // namespace

ShapeMesh shapeMesh(VirtualShape shape) {
    const Eigen::Vector3f x = Eigen::Vector3f::UnitX(), y = Eigen::Vector3f::UnitY(),
                          z = Eigen::Vector3f::UnitZ();
    ShapeMesh mesh;
    if (shape == VirtualShape::Quad) {
        addSide(mesh, {z, x, y}, false, 0);
        return mesh;
    }
    const bool round = shape == VirtualShape::Sphere;
    for (const Side& side : {Side{x, y, z}, Side{-x, z, y}, Side{y, z, x}, Side{-y, x, z},
                             Side{z, x, y}, Side{-z, y, x}})
        addSide(mesh, side, round, 1);
    return mesh;
}

}  // namespace mfar
