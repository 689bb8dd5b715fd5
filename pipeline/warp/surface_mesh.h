#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

struct SurfaceVertex {
    float position[3], uv[2];
};

/// Triangles to be drawn through a distorting lens. The lens model is applied only to the corners.
struct SurfaceMesh {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Halves edges until no edge is longer than `longest` [m]; 0: no edge is cut. Triangles with a
/// common edge cut it at the same points, so that no gap appears. `longest` is doubled until at
/// most `mostTriangles` triangles result. A mesh that already has more triangles than
/// `mostTriangles` stays uncut. `uvs` has one entry per vertex or is empty. Triangles are omitted
/// if a corner is not finite or an index is out of range.
[[nodiscard]] SurfaceMesh surfaceMesh(std::span<const Eigen::Vector3f> positions,
                                      std::span<const Eigen::Vector2f> uvs,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      float longest, std::size_t mostTriangles = 50000);

/// Reduces a mesh to at most `mostTriangles`. All vertices in a grid cell are replaced by one point
/// (Rossignac and Borrel 1993). The point is near the planes of the triangles that meet in the
/// cell, so curved surfaces do not shrink, and sharp edges stay sharp.
[[nodiscard]] SurfaceMesh simplified(SurfaceMesh mesh, std::size_t mostTriangles);

}  // namespace mfar
