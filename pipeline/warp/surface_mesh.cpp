#include "pipeline/warp/surface_mesh.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace mfar {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Eigen::Vector3f positionOf(const SurfaceVertex& v) {
    return {v.position[0], v.position[1], v.position[2]};
}

SurfaceVertex middle(const SurfaceVertex& a, const SurfaceVertex& b) {
    SurfaceVertex m{};
    for (int i = 0; i < 3; ++i)
        m.position[i] = 0.5F * (a.position[i] + b.position[i]);
    for (int i = 0; i < 2; ++i)
        m.uv[i] = 0.5F * (a.uv[i] + b.uv[i]);
    return m;
}

SurfaceMesh soundPart(std::span<const Eigen::Vector3f> positions,
                      std::span<const Eigen::Vector2f> uvs, std::span<const Triangle> triangles) {
    SurfaceMesh mesh;
    mesh.vertices.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        std::copy_n(positions[i].data(), 3, mesh.vertices[i].position);
        if (i < uvs.size()) std::copy_n(uvs[i].data(), 2, mesh.vertices[i].uv);
    }
    for (const Triangle& t : triangles)
        if (std::ranges::all_of(t, [&](std::uint32_t corner) {
                return corner < positions.size() && positions[corner].allFinite();
            }))
            mesh.triangles.push_back(t);
    return mesh;
}

/// Cuts triangles until no edge is longer than `longest`. Cutting the longest edge first gives
/// well-shaped triangles. Returns false if there would be more than `most` triangles.
bool cut(SurfaceMesh& mesh, float longest, std::size_t most) {
    for (std::size_t i = 0; i < mesh.triangles.size();) {
        const Triangle t = mesh.triangles[i];
        std::array<float, 3> length{};
        for (std::size_t k = 0; k < 3; ++k)
            length[k] =
                (positionOf(mesh.vertices[t[k]]) - positionOf(mesh.vertices[t[(k + 1) % 3]]))
                    .norm();
        const auto k = static_cast<std::size_t>(std::ranges::max_element(length) - length.begin());
        if (!(length[k] > longest)) {
            ++i;
            continue;
        }
        if (mesh.triangles.size() >= most) return false;
        const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
        const auto m = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(middle(mesh.vertices[a], mesh.vertices[b]));
        mesh.triangles[i] = {a, m, c};
        mesh.triangles.push_back({m, b, c});
    }
    return true;
}

/// A grid cell whose vertices are replaced by one point. Coordinates are relative to the centre of
/// the mesh's bounding box. This keeps rounding errors small, even far from the model's origin.
class Cell {
public:
    void add(const Eigen::Vector3f& vertex) {
        sum_ += vertex;
        ++count_;
    }
    /// Adds the plane normal . point = offset of a triangle that has a corner in the cell.
    void addPlane(const Eigen::Vector3f& normal, float offset, float area) {
        normals_ += area * normal * normal.transpose();
        offsets_ += area * offset * normal;
    }
    /// Returns the point with the smallest sum of squared distances from the planes, weighted with
    /// the areas. In directions in which the planes hardly determine this point, the mean of the
    /// vertices is used (Lindstrom 2000). Returns the mean of the vertices if the point is farther
    /// than `farthest` from this mean.
    [[nodiscard]] Eigen::Vector3f point(float farthest) const;

private:
    Eigen::Vector3f sum_{0, 0, 0}, offsets_{0, 0, 0};
    Eigen::Matrix3f normals_ = Eigen::Matrix3f::Zero();
    float count_ = 0;
};

Eigen::Vector3f Cell::point(float farthest) const {
    // The planes determine where the point lies in the direction of an eigenvector only if the
    // eigenvalue of this direction is at least this share of the largest eigenvalue.
    constexpr float kDetermined = 0.1F;
    const Eigen::Vector3f mean = sum_ / count_;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes;
    axes.computeDirect(normals_);
    const Eigen::Vector3f& values = axes.eigenvalues();
    const Eigen::Matrix3f& directions = axes.eigenvectors();
    const Eigen::Vector3f rest = directions.transpose() * (offsets_ - normals_ * mean);
    Eigen::Vector3f step = Eigen::Vector3f::Zero();
    for (int i = 0; i < 3; ++i)
        if (values[i] > kDetermined * values[2]) step += rest[i] / values[i] * directions.col(i);
    return step.norm() <= farthest ? Eigen::Vector3f(mean + step) : mean;
}

/// Puts vertices of a grid cell that are connected by edges into one group. Each group gets its own
/// texture coordinate, so that the two sides of a texture seam stay separate.
class Groups {
public:
    explicit Groups(std::size_t vertices) : parents_(vertices) {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }
    std::uint32_t of(std::uint32_t vertex) {
        while (parents_[vertex] != vertex)
            vertex = parents_[vertex] = parents_[parents_[vertex]];
        return vertex;
    }
    void join(std::uint32_t a, std::uint32_t b) { parents_[of(a)] = of(b); }

private:
    std::vector<std::uint32_t> parents_;
};

/// The cells of a cubic grid that have vertices.
struct Grid {
    Eigen::Vector3f centre;  ///< centre of the mesh's bounding box
    float side;              ///< length of a cell's edges
    std::vector<Cell> cells;
    std::vector<std::uint32_t> cellOf;  ///< index in `cells` for each vertex

    [[nodiscard]] bool keeps(const Triangle& t) const {
        const std::uint32_t a = cellOf[t[0]], b = cellOf[t[1]], c = cellOf[t[2]];
        return a != b && b != c && c != a;
    }
    [[nodiscard]] std::size_t keptOf(const SurfaceMesh& mesh) const {
        return static_cast<std::size_t>(
            std::ranges::count_if(mesh.triangles, [this](const Triangle& t) { return keeps(t); }));
    }
};

Grid gridOf(const SurfaceMesh& mesh, const Eigen::AlignedBox3f& box, int cells) {
    Grid out{box.center(), box.sizes().maxCoeff() / static_cast<float>(cells), {}, {}};
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
    out.cellOf.reserve(mesh.vertices.size());
    for (const SurfaceVertex& v : mesh.vertices) {
        const Eigen::Array3f at = (positionOf(v) - box.min()).array() / out.side;
        const auto index = at.max(0).min(static_cast<float>(cells)).cast<std::uint64_t>().eval();
        const std::uint64_t key = index.x() << 40 | index.y() << 20 | index.z();
        const auto number = static_cast<std::uint32_t>(out.cells.size());
        const auto [place, isNew] = numbers.try_emplace(key, number);
        if (isNew) out.cells.emplace_back();
        out.cellOf.push_back(place->second);
        out.cells[place->second].add(positionOf(v) - out.centre);
    }
    return out;
}

void addPlanes(const SurfaceMesh& mesh, Grid& grid) {
    for (const Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t i) {
            return Eigen::Vector3f(positionOf(mesh.vertices[t[i]]) - grid.centre);
        };
        const Eigen::Vector3f first = corner(0);
        const Eigen::Vector3f across = (corner(1) - first).cross(corner(2) - first);
        const float area = across.norm();
        if (!(area > 0)) continue;
        const Eigen::Vector3f normal = across / area;
        for (const std::uint32_t vertex : t)
            grid.cells[grid.cellOf[vertex]].addPlane(normal, normal.dot(first), area);
    }
}

struct UvSum {
    std::array<float, 2> uv{};
    float count = 0;
    std::uint32_t vertex = kNoVertex;
    static constexpr std::uint32_t kNoVertex = 0xFFFFFFFF;
};

SurfaceMesh clustered(const SurfaceMesh& mesh, Grid grid) {
    addPlanes(mesh, grid);
    const std::vector<std::uint32_t>& cellOf = grid.cellOf;
    Groups groups(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            if (cellOf[t[i]] == cellOf[t[(i + 1) % 3]]) groups.join(t[i], t[(i + 1) % 3]);
    std::vector<UvSum> sums(mesh.vertices.size());
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        UvSum& sum = sums[groups.of(i)];
        for (std::size_t k = 0; k < 2; ++k)
            sum.uv[k] += mesh.vertices[i].uv[k];
        ++sum.count;
    }
    SurfaceMesh out;
    const auto drawn = [&](std::uint32_t vertex) {
        UvSum& sum = sums[groups.of(vertex)];
        if (sum.vertex != UvSum::kNoVertex) return sum.vertex;
        const Eigen::Vector3f at = grid.centre + grid.cells[cellOf[vertex]].point(grid.side);
        SurfaceVertex v{};
        std::copy_n(at.data(), 3, v.position);
        for (std::size_t k = 0; k < 2; ++k)
            v.uv[k] = sum.uv[k] / sum.count;
        sum.vertex = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(v);
        return sum.vertex;
    };
    for (const Triangle& t : mesh.triangles)
        if (grid.keeps(t)) out.triangles.push_back({drawn(t[0]), drawn(t[1]), drawn(t[2])});
    return out;
}

Eigen::AlignedBox3f cornersBox(const SurfaceMesh& mesh) {
    Eigen::AlignedBox3f box;
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t corner : t)
            box.extend(positionOf(mesh.vertices[corner]));
    return box;
}

}  // namespace

SurfaceMesh simplified(SurfaceMesh mesh, std::size_t mostTriangles) {
    if (mesh.triangles.size() <= mostTriangles) return mesh;
    const Eigen::AlignedBox3f box = cornersBox(mesh);
    if (!(box.sizes().maxCoeff() > 0)) return {};
    // Vertices that belong to no triangle can be infinite or NaN, so they are moved to a corner of
    // the box.
    for (SurfaceVertex& v : mesh.vertices)
        if (!box.contains(positionOf(v))) std::copy_n(box.min().data(), 3, v.position);
    for (int cells = 256; cells > 1; cells = cells * 3 / 4) {
        Grid grid = gridOf(mesh, box, cells);
        if (grid.keptOf(mesh) <= mostTriangles) return clustered(mesh, std::move(grid));
    }
    return clustered(mesh, gridOf(mesh, box, 1));
}

SurfaceMesh surfaceMesh(std::span<const Eigen::Vector3f> positions,
                        std::span<const Eigen::Vector2f> uvs, std::span<const Triangle> triangles,
                        float longest, std::size_t mostTriangles) {
    SurfaceMesh whole = soundPart(positions, uvs, triangles);
    const std::size_t most = std::max(mostTriangles, whole.triangles.size());
    for (; longest > 0 && std::isfinite(longest); longest *= 2) {
        SurfaceMesh mesh = whole;
        if (cut(mesh, longest, most)) return mesh;
    }
    return whole;
}

}  // namespace mfar
