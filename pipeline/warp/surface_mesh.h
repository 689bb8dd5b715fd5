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

/// Triangles to be drawn through a lens, which moves only their corners.
struct SurfaceMesh {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Halves edges until none is longer than `longest` [m]. Two triangles cut a common edge at the
/// same points, so that no gap appears. `longest` is increased if the result would have more than
/// `mostTriangles` (or the mesh's own number). `uvs`: one per vertex, or empty. Triangles with a
/// corner that is not finite or out of range are omitted.
[[nodiscard]] SurfaceMesh surfaceMesh(std::span<const Eigen::Vector3f> positions,
                                      std::span<const Eigen::Vector2f> uvs,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      float longest, std::size_t mostTriangles = 50000);

/// Reduces a mesh to at most `mostTriangles` by merging the corners within each cell of a grid into
/// their mean (Rossignac and Borrel 1993): a smooth surface moves by a small fraction of a cell. A
/// smaller mesh stays unchanged.
[[nodiscard]] SurfaceMesh simplified(SurfaceMesh mesh, std::size_t mostTriangles);

}  // namespace mfar
