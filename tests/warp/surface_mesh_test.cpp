#include "pipeline/warp/surface_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <utility>

namespace mfar {
namespace {

using Eigen::Vector3f;

Vector3f at(const SurfaceMesh& mesh, std::uint32_t i) {
    const float* p = mesh.vertices[i].position;
    return {p[0], p[1], p[2]};
}

float areaOf(const SurfaceMesh& mesh) {
    float sum = 0;
    for (const auto& t : mesh.triangles)
        sum +=
            0.5F * (at(mesh, t[1]) - at(mesh, t[0])).cross(at(mesh, t[2]) - at(mesh, t[0])).norm();
    return sum;
}

TEST(SurfaceMesh, LongEdgesAreDividedAtTheSamePointsInBothAdjacentTriangles) {
    const std::vector<Vector3f> corners{{0, 0, 0}, {3, 0, 0}, {3, 1, 0.5F}, {0.3F, 1, 0}};
    const std::vector<std::array<std::uint32_t, 3>> two{{0, 1, 2}, {0, 2, 3}};
    const SurfaceMesh mesh = surfaceMesh(corners, {}, two, 0.4F);
    std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> edges;
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3f a = at(mesh, t[k]), b = at(mesh, t[(k + 1) % 3]);
            EXPECT_LE((a - b).norm(), 0.4F);
            std::array<float, 3> from{a.x(), a.y(), a.z()}, to{b.x(), b.y(), b.z()};
            if (to < from) std::swap(from, to);
            ++edges[{from, to}];
        }
    // Length of the outline, which consists of the edges that belong to only one triangle. A torn
    // inner edge makes the outline longer.
    double outline = 0;
    for (const auto& [edge, triangles] : edges) {
        EXPECT_LE(triangles, 2);
        const Vector3f a(edge.first.data()), b(edge.second.data());
        if (triangles == 1) outline += (a - b).norm();
    }
    double wanted = 0;
    for (std::size_t i = 0; i < 4; ++i)
        wanted += (corners[i] - corners[(i + 1) % 4]).norm();
    EXPECT_NEAR(outline, wanted, 1e-4);
}

TEST(SurfaceMesh, InvalidTrianglesAreSkippedAndTheNumberOfTrianglesIsLimited) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Vector3f> corners{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {kNan, 0, 0}};
    const SurfaceMesh mesh = surfaceMesh(
        corners, {},
        std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 1, 3}, {0, 1, 9}, {1, 1, 1}},
        0.001F, 1000);
    EXPECT_GT(mesh.triangles.size(), 100U);
    EXPECT_LE(mesh.triangles.size(), 1000U);
    EXPECT_NEAR(areaOf(mesh), 5000, 1);
    EXPECT_TRUE(surfaceMesh({}, {}, {}, 1).triangles.empty());
}

TEST(SurfaceMesh, SimplifiedMeshStaysCloseToASmoothSurface) {
    std::vector<Vector3f> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    constexpr std::uint32_t kSide = 200;
    for (std::uint32_t j = 0; j <= kSide; ++j)
        for (std::uint32_t i = 0; i <= kSide; ++i) {
            const float x = static_cast<float>(i) / kSide, y = static_cast<float>(j) / kSide;
            corners.emplace_back(x, y, 0.1F * std::sin(4 * x) * std::cos(3 * y));
            if (i == kSide || j == kSide) continue;
            const std::uint32_t a = j * (kSide + 1) + i, below = a + kSide + 1;
            triangles.push_back({a, a + 1, below});
            triangles.push_back({a + 1, below + 1, below});
        }
    const SurfaceMesh whole = surfaceMesh(corners, {}, triangles, 0);
    const SurfaceMesh few = simplified(whole, 5000);
    EXPECT_GT(few.triangles.size(), 1500U);
    EXPECT_LE(few.triangles.size(), 5000U);
    EXPECT_NEAR(areaOf(few), areaOf(whole), 0.05F);
    for (const SurfaceVertex& v : few.vertices)
        EXPECT_NEAR(v.position[2], 0.1F * std::sin(4 * v.position[0]) * std::cos(3 * v.position[1]),
                    1e-3);
    EXPECT_EQ(simplified(whole, 80000).triangles.size(), whole.triangles.size());
}

// The mesh is a pipe. The texture coordinate u runs from 0 to 1 around it.
TEST(SurfaceMesh, ASimplifiedMeshKeepsBothTextureCoordinatesAtASeam) {
    std::vector<Vector3f> corners;
    std::vector<Eigen::Vector2f> uvs;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    constexpr std::uint32_t kAround = 200;
    for (std::uint32_t j = 0; j <= kAround; ++j)
        for (std::uint32_t i = 0; i <= kAround; ++i) {
            const float u = static_cast<float>(i) / kAround, v = static_cast<float>(j) / kAround;
            const float angle = 2 * std::numbers::pi_v<float> * u;
            corners.emplace_back(std::cos(angle), std::sin(angle), v);
            uvs.emplace_back(u, v);
            if (i == kAround || j == kAround) continue;
            const std::uint32_t a = j * (kAround + 1) + i, below = a + kAround + 1;
            triangles.push_back({a, a + 1, below});
            triangles.push_back({a + 1, below + 1, below});
        }
    const SurfaceMesh few = simplified(surfaceMesh(corners, uvs, triangles, 0), 5000);
    EXPECT_GT(few.triangles.size(), 1500U);
    for (const auto& t : few.triangles) {
        const auto [least, most] = std::minmax(
            {few.vertices[t[0]].uv[0], few.vertices[t[1]].uv[0], few.vertices[t[2]].uv[0]});
        ASSERT_LT(most - least, 0.05F);
    }
    for (const SurfaceVertex& v : few.vertices)
        EXPECT_NEAR(std::hypot(v.position[0], v.position[1]), 1, 0.01F);
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct Lattice {
    std::vector<Vector3f> corners;
    Triangles triangles;

    /// Adds side x side squares. Their corners are point(u, v), with u and v from 0 to 1.
    template <class Point>
    void add(std::uint32_t side, const Point& point) {
        const auto first = static_cast<std::uint32_t>(corners.size());
        for (std::uint32_t j = 0; j <= side; ++j)
            for (std::uint32_t i = 0; i <= side; ++i) {
                corners.push_back(point(static_cast<float>(i) / static_cast<float>(side),
                                        static_cast<float>(j) / static_cast<float>(side)));
                if (i == side || j == side) continue;
                const std::uint32_t a = first + j * (side + 1) + i, below = a + side + 1;
                triangles.push_back({a, a + 1, below});
                triangles.push_back({a + 1, below + 1, below});
            }
    }
    [[nodiscard]] SurfaceMesh simplifiedTo(std::size_t mostTriangles) const {
        return simplified(surfaceMesh(corners, {}, triangles, 0), mostTriangles);
    }
};

TEST(SurfaceMesh, ASimplifiedSphereKeepsItsVolume) {
    constexpr float kRadius = 0.5F, kPi = std::numbers::pi_v<float>;
    const Vector3f middle(20, -30, 10);
    Lattice sphere;
    sphere.add(160, [&](float u, float v) {
        const float around = 2 * kPi * u, down = kPi * v;
        return Vector3f(middle + kRadius * Vector3f(std::sin(down) * std::cos(around),
                                                    std::sin(down) * std::sin(around),
                                                    std::cos(down)));
    });
    const SurfaceMesh few = sphere.simplifiedTo(1500);
    EXPECT_GT(few.triangles.size(), 500U);
    double volume = 0;
    for (const auto& t : few.triangles) {
        const Vector3f a = at(few, t[0]) - middle, b = at(few, t[1]) - middle;
        volume += static_cast<double>(a.cross(b).dot(at(few, t[2]) - middle)) / 6;
    }
    const double whole = 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3.0);
    EXPECT_NEAR(std::abs(volume) / whole, 1, 0.008);
}

TEST(SurfaceMesh, EdgesOfASimplifiedBoxStaySharp) {
    const Vector3f size(1, 0.7F, 0.45F);
    Lattice box;
    for (int axis = 0; axis < 3; ++axis)
        for (const float end : {0.0F, 1.0F})
            box.add(60, [&](float u, float v) {
                Vector3f p;
                p[axis] = end;
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                return Vector3f(p.cwiseProduct(size));
            });
    const SurfaceMesh few = box.simplifiedTo(4000);
    EXPECT_GT(few.triangles.size(), 1000U);
    Vector3f least = size, most = Vector3f::Zero();
    for (std::uint32_t i = 0; i < few.vertices.size(); ++i) {
        const Vector3f p = at(few, i);
        EXPECT_NEAR(p.cwiseMin(size - p).minCoeff(), 0, 1e-4F);
        least = least.cwiseMin(p);
        most = most.cwiseMax(p);
    }
    EXPECT_LT(least.cwiseAbs().maxCoeff(), 1e-4F);
    EXPECT_LT((most - size).cwiseAbs().maxCoeff(), 1e-4F);
    EXPECT_NEAR(areaOf(few), 2 * (0.7F + 0.45F + 0.7F * 0.45F), 1e-3F);
}

// The mesh is two sheets like a roof without its ridge. The gap between them is up to two grid
// cells wide, so there are cells with both sheets, whose planes meet far above.
TEST(SurfaceMesh, AnOpenEdgeOfASimplifiedMeshGetsNoSpikes) {
    constexpr float kCell = 1.0F / 256, kHeight = 25 * kCell, kSlope = 0.34F;
    Lattice roof;
    for (const float side : {-1.0F, 1.0F})
        roof.add(300, [&](float u, float v) {
            return Vector3f(side * (kCell * u + kSlope * kHeight * v), u, -kHeight * v);
        });
    const SurfaceMesh few = roof.simplifiedTo(50000);
    EXPECT_GT(few.triangles.size(), 10000U);
    for (const SurfaceVertex& v : few.vertices)
        EXPECT_LT(v.position[2], kCell);
}

TEST(SurfaceMesh, ASimplifiedRoughSurfaceIsNotFolded) {
    std::minstd_rand random(1);
    std::uniform_real_distribution<float> height(0, 5e-4F);
    Lattice rough;
    rough.add(200, [&](float u, float v) { return Vector3f(u, v, height(random)); });
    const SurfaceMesh few = rough.simplifiedTo(5000);
    EXPECT_GT(few.triangles.size(), 1000U);
    for (const auto& t : few.triangles) {
        const Vector3f a = at(few, t[0]), across = (at(few, t[1]) - a).cross(at(few, t[2]) - a);
        EXPECT_GT(across.z(), 0);
    }
}

}  // namespace
}  // namespace mfar
