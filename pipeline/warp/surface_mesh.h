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

/// Triangles to be drawn through a lens, which acts on their corners alone.
struct SurfaceMesh {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Cuts edges longer than `longest` [m] in halves until there is none left. Two triangles with an
/// edge in common cut it at the same points, so that nothing shows between them. `longest` grows
/// by itself where more than `mostTriangles` (or the mesh's own number) would come of it. `uvs`:
/// one a vertex, or none. Triangles with a corner that is not finite or out of range are left out.
[[nodiscard]] SurfaceMesh surfaceMesh(std::span<const Eigen::Vector3f> positions,
                                      std::span<const Eigen::Vector2f> uvs,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      float longest, std::size_t mostTriangles = 50000);

/// At most `mostTriangles`, by drawing the corners in cells of a grid together into their mean
/// (Rossignac and Borrel 1993): a smooth surface moves by a small part of a cell. What has fewer is
/// left as it is.
[[nodiscard]] SurfaceMesh simplified(SurfaceMesh mesh, std::size_t mostTriangles);

}  // namespace mfar
