#include "pipeline/models/lathe.h"
#include "pipeline/models/showpiece.h"
#include "tests/fuzz/sound_model.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>
#include <set>

namespace mfar {
namespace {

double volumeOf(const Mesh& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        volume += mesh.positions[a].cast<double>().dot(
                      mesh.positions[b].cast<double>().cross(mesh.positions[c].cast<double>())) /
                  6;
    return volume;
}

TEST(Lathe, AHalfCircleProfileGivesASphere) {
    LatheProfile half;
    for (int i = 0; i <= 64; ++i) {
        const float turn = std::numbers::pi_v<float> * static_cast<float>(i) / 64;
        half.emplace_back(std::sin(turn), -std::cos(turn));
    }
    half.back().x() = 0;
    Mesh mesh;
    addTurned(mesh, half, {.around = 128});
    EXPECT_NEAR(volumeOf(mesh), 4 * std::numbers::pi / 3, 0.01) << "triangles must face outwards";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        ASSERT_GT(mesh.normals[i].dot(mesh.positions[i]), 0.998F);
    EXPECT_EQ(mesh.triangles.size(), 128U * (2 * 64 - 2))
        << "there must be no triangles without area at the poles";
    EXPECT_EQ(mesh.uvs.front(), Eigen::Vector2f(0, 1));
    EXPECT_EQ(mesh.uvs.back(), Eigen::Vector2f(1, 0));
}

TEST(Lathe, SmoothProfilesPassThroughTheirKnots) {
    const LatheProfile knots = {{1, 0}, {2, 1}, {1.5F, 3}, {0, 4}};
    const LatheProfile profile = smoothProfile(knots, 31);
    ASSERT_EQ(profile.size(), 31U);
    for (std::size_t i = 0; i < knots.size(); ++i)
        EXPECT_LT((profile[10 * i] - knots[i]).norm(), 1e-5F);
}

TEST(Showpiece, IsAValidModelThatStandsOnTheTable) {
    const Model model = showpiece();
    EXPECT_NO_THROW(test::requireSoundModel(model));
    std::size_t triangles = 0;
    Eigen::AlignedBox3f box;
    std::set<int> materials;
    for (const Mesh& mesh : model.meshes) {
        triangles += mesh.triangles.size();
        materials.insert(mesh.material);
        for (const Eigen::Vector3f& p : mesh.positions)
            box.extend(p);
        EXPECT_GT(volumeOf(mesh), 0) << "triangles must face outwards";
    }
    EXPECT_GE(triangles, 5'000U);
    EXPECT_LE(triangles, 60'000U);
    EXPECT_EQ(materials.size(), model.materials.size());
    EXPECT_EQ(box.min().z(), 0);
    EXPECT_NEAR(box.max().z(), 0.145F, 1e-4F);
    EXPECT_LT(box.center().head<2>().norm(), 1e-3F);
}

// A triangle that faces away from its normals would be black, or lit from inside.
TEST(Showpiece, NormalsAgreeWithTriangles) {
    const Model model = showpiece();
    for (const Mesh& mesh : model.meshes) {
        std::size_t against = 0;
        for (const auto& [a, b, c] : mesh.triangles) {
            const Eigen::Vector3f front = (mesh.positions[b] - mesh.positions[a])
                                              .cross(mesh.positions[c] - mesh.positions[a]);
            for (const std::uint32_t i : {a, b, c})
                if (!(mesh.normals[i].dot(front) > 0)) ++against;
        }
        EXPECT_EQ(against, 0U) << "normals point away from their triangle's front; material "
                               << mesh.material;
    }
}

}  // namespace
}  // namespace mfar
