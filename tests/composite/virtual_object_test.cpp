#include "pipeline/composite/virtual_object.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

namespace mfar {
namespace {

/// A vector along the triangle's normal. Its length is twice the triangle's area.
Eigen::Vector3f cross(const ShapeMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const auto at = [&](int i) { return mesh.vertices[t[i]].position; };
    return (at(1) - at(0)).cross(at(2) - at(0));
}

TEST(ShapeMesh, TrianglesFaceOutwardsAlongTheNormalsOfTheirVertices) {
    for (const VirtualShape shape : {VirtualShape::Box, VirtualShape::Sphere, VirtualShape::Quad}) {
        const ShapeMesh mesh = shapeMesh(shape);
        ASSERT_FALSE(mesh.triangles.empty());
        for (const auto& t : mesh.triangles)
            for (const std::uint32_t i : t) {
                ASSERT_LT(i, mesh.vertices.size());
                const ShapeMesh::Vertex& v = mesh.vertices[i];
                EXPECT_NEAR(v.normal.norm(), 1, 1e-5);
                EXPECT_GT(cross(mesh, t).normalized().dot(v.normal), 0.99);
                if (shape != VirtualShape::Quad) {
                    EXPECT_GT(v.position.dot(v.normal), 0.49);
                }
                EXPECT_TRUE((v.uv.array() >= 0).all() && (v.uv.array() <= 1).all());
            }
    }
}

TEST(ShapeMesh, AreasAndVolumesMatchTheShapes) {
    const auto measure = [](VirtualShape shape) {
        double area = 0, volume = 0;
        const ShapeMesh mesh = shapeMesh(shape);
        for (const auto& t : mesh.triangles) {
            area += 0.5 * cross(mesh, t).norm();
            volume += cross(mesh, t).dot(mesh.vertices[t[0]].position) / 6;
        }
        return std::pair(area, volume);
    };
    EXPECT_NEAR(measure(VirtualShape::Quad).first, 1, 1e-5);
    EXPECT_NEAR(measure(VirtualShape::Box).first, 6, 1e-4);
    EXPECT_NEAR(measure(VirtualShape::Box).second, 1, 1e-4);
    EXPECT_NEAR(measure(VirtualShape::Sphere).first, 3.14159, 5e-3);
    EXPECT_NEAR(measure(VirtualShape::Sphere).second, 0.523599, 2e-3);
}

TEST(ShapeMesh, SolidsAreClosed) {
    using Point = std::tuple<long, long, long>;
    for (const VirtualShape shape : {VirtualShape::Box, VirtualShape::Sphere}) {
        const ShapeMesh mesh = shapeMesh(shape);
        const auto key = [&](std::uint32_t i) {
            const Eigen::Vector3f p = 1e4F * mesh.vertices[i].position;
            return Point{std::lround(p.x()), std::lround(p.y()), std::lround(p.z())};
        };
        std::map<std::pair<Point, Point>, int> edges;
        for (const auto& t : mesh.triangles)
            for (int i = 0; i < 3; ++i) {
                const Point a = key(t[i]), b = key(t[(i + 1) % 3]);
                edges[std::minmax(a, b)] += a < b ? 1 : -1;
            }
        for (const auto& [edge, sum] : edges)
            ASSERT_EQ(sum, 0);
    }
}

}  // namespace
}  // namespace mfar
