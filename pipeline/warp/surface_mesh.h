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

/// Triangles that are drawn through a distorting lens. The lens model is applied only to the
/// corners.
struct SurfaceMesh {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Halves edges until no edge is longer than `longest` [m]. Two triangles with a common edge cut it
/// at the same points, so that no gap appears. If the result would have more than `mostTriangles`
/// triangles, `longest` is doubled as often as necessary. A mesh that has more triangles before the
/// cut is not cut. `uvs` has one entry per vertex or is empty. A triangle is omitted if a corner is
/// not finite or a corner's index is out of range.
[[nodiscard]] SurfaceMesh surfaceMesh(std::span<const Eigen::Vector3f> positions,
                                      std::span<const Eigen::Vector2f> uvs,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      float longest, std::size_t mostTriangles = 50000);

/// Reduces a mesh to at most `mostTriangles`. All corners in a cell of a grid are replaced by their
/// mean (Rossignac and Borrel 1993), which moves a smooth surface by a small fraction of a cell. A
/// mesh that has no more triangles than this stays unchanged.
[[nodiscard]] SurfaceMesh simplified(SurfaceMesh mesh, std::size_t mostTriangles);

}  // namespace mfar
