#include "pipeline/models/gltf_model.h"
#include "tests/models/gltf_maker.h"
#include "tests/models/near_points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar {
namespace {

using test::expectNear;
using test::GltfMaker;
using test::modelOf;
using test::oneTriangle;

/// Returns the position of a vertex of the model at `time` [s].
Eigen::Vector3d vertexAt(const Model& model, std::size_t mesh, std::size_t vertex, double time) {
    const Mesh& m = model.meshes.at(mesh);
    const Eigen::Vector3d p = m.positions.at(vertex).cast<double>();
    return m.part == 0 ? p : model.paths.at(static_cast<std::size_t>(m.part) - 1).at(time) * p;
}

const double kHalf = std::sqrt(0.5);

/// One triangle that moves by 2 m along glTF's y axis, which is z of the model, in 4 s.
GltfMaker risingTriangle() {
    GltfMaker maker = oneTriangle();
    maker.animate(0, "translation", {0, 4}, {1, 0, 0, 1, 2, 0});
    return maker;
}

TEST(GltfMotion, ATranslationAlongYInTheFileMovesThePartAlongZ) {
    const Model model = modelOf(risingTriangle());
    ASSERT_EQ(model.paths.size(), 1U);
    EXPECT_EQ(model.paths[0].length, 4);
    EXPECT_TRUE(model.notes.empty());
    expectNear(vertexAt(model, 0, 1, 0), {2, 0, 0});
    expectNear(vertexAt(model, 0, 1, 1), {2, 0, 0.5});
}

TEST(GltfMotion, AnAnimationWithoutMotionIsAPose) {
    for (const bool once : {true, false}) {
        GltfMaker maker = oneTriangle();
        maker.root["nodes"][0]["scale"] = {3, 1, 1};
        if (once)
            maker.animate(0, "translation", {0}, {1, 2, 0});
        else
            maker.animate(0, "translation", {0, 4}, {1, 2, 0, 1, 2, 0});
        const Model model = modelOf(maker);
        EXPECT_TRUE(model.paths.empty());
        EXPECT_EQ(model.meshes.at(0).part, 0);
        expectNear(vertexAt(model, 0, 1, 0), {4, 0, 2});
    }
}

TEST(GltfMotion, ARotationTurnsAboutTheNodesOrigin) {
    GltfMaker maker = oneTriangle();
    maker.root["nodes"][0]["translation"] = {5, 0, 0};
    const auto half = static_cast<float>(kHalf);
    maker.animate(0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, half, half});
    const Model model = modelOf(maker);
    expectNear(vertexAt(model, 0, 1, 0), {6, 0, 0});
    expectNear(vertexAt(model, 0, 1, 0.5), {5 + kHalf, 0, kHalf});
}

TEST(GltfMotion, ScalesAboveAndBelowAMovingNodeAreKept) {
    GltfMaker maker = risingTriangle();
    nlohmann::json& nodes = maker.root["nodes"];
    nodes[0]["scale"] = {1, 3, 1};
    nodes.push_back({{"children", {0}}, {"scale", {2, 2, 2}}, {"translation", {0, 10, 0}}});
    maker.root["scenes"][0]["nodes"] = {1};
    const Model model = modelOf(maker);
    EXPECT_TRUE(model.notes.empty());
    // In glTF's axes, the vertex is at (0, 10, 0) + 2 ((1, t / 2, 0) + (1, 3, 1) (0, 1, 0)), where
    // (a) (b) is the product of components. The model's z is glTF's y.
    expectNear(vertexAt(model, 0, 2, 0), {2, 0, 16});
    expectNear(vertexAt(model, 0, 2, 2), {2, 0, 18});
}

TEST(GltfMotion, AChildMovesWithItsParentsMotion) {
    GltfMaker maker = risingTriangle();
    nlohmann::json& nodes = maker.root["nodes"];
    nodes.push_back({{"mesh", 0}, {"translation", {0, 0, -1}}});
    nodes.push_back({{"mesh", 0}});
    nodes[0]["children"] = {1, 2};
    const auto half = static_cast<float>(kHalf);
    maker.animate(2, "rotation", {0, 4}, {0, 0, 0, 1, 0, 0, half, half});
    const Model model = modelOf(maker);
    ASSERT_EQ(model.meshes.size(), 3U);
    ASSERT_EQ(model.paths.size(), 2U);
    EXPECT_EQ(model.meshes[1].part, model.meshes[0].part)
        << "the first child does not move relative to its parent";
    expectNear(vertexAt(model, 1, 0, 2), {1, 1, 1});
    expectNear(vertexAt(model, 2, 1, 2), {1 + kHalf, 0, 1 + kHalf});
}

TEST(GltfMotion, StepsAndSplinesAreRead) {
    GltfMaker maker = oneTriangle();
    maker.animate(0, "translation", {0, 1}, {0, 0, 0, 8, 0, 0})["interpolation"] = "STEP";
    expectNear(vertexAt(modelOf(maker), 0, 0, 0.5), {0, 0, 0});
    GltfMaker spline = oneTriangle();
    spline.animate(0, "translation", {0, 2},
                   {0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0, 0})["interpolation"] =
        "CUBICSPLINE";
    // Halfway, the value is the mean of both values, plus an eighth of the duration times the first
    // tangent.
    expectNear(vertexAt(modelOf(spline), 0, 0, 1), {4 + 2.0 / 8 * 4, 0, 0});
}

TEST(GltfMotion, AnimationsThatAreNotPlayedAreNotedOnce) {
    GltfMaker maker = oneTriangle();
    maker.animate(0, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    maker.animate(0, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    maker.root["animations"].push_back(maker.root["animations"][0]);
    const Model model = modelOf(maker);
    EXPECT_TRUE(model.paths.empty());
    EXPECT_EQ(model.notes,
              (std::vector<std::string>{
                  "test.glb: animations[1]: only the first animation is played",
                  "test.glb: animations[0].channels[0]: changes of the scale are not played"}));
}

TEST(GltfMotion, ANodeBelowAnUnequalScaleRests) {
    GltfMaker maker = risingTriangle();
    maker.root["nodes"].push_back({{"children", {0}}, {"scale", {2, 1, 2}}});
    maker.root["scenes"][0]["nodes"] = {1};
    const Model model = modelOf(maker);
    EXPECT_TRUE(model.paths.empty());
    EXPECT_EQ(model.notes, std::vector<std::string>{
                               "test.glb: nodes[0]: the node does not move, because a parent "
                               "scales it unequally or mirrors it"});
}

TEST(GltfMotion, OnlySixteenNodesMove) {
    GltfMaker maker = oneTriangle();
    for (int node = 1; node < 20; ++node) {
        maker.root["nodes"].push_back({{"mesh", 0}});
        maker.root["scenes"][0]["nodes"].push_back(node);
        maker.animate(node, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    }
    const Model model = modelOf(maker);
    EXPECT_EQ(model.paths.size(), 16U);
    EXPECT_EQ(model.meshes.size(), 20U);
    EXPECT_EQ(model.notes.size(), 1U);
}

/// Returns the error message of a model with a changed animation.
template <class Change>
std::string faultOf(const Change& change) {
    GltfMaker maker = risingTriangle();
    change(maker);
    try {
        (void)modelOf(maker);
        return "";
    } catch (const ModelError& error) {
        return error.what();
    }
}

TEST(GltfMotion, KeyframesAreCountedWhereverTheyAreStored) {
    GltfMaker maker = risingTriangle();
    maker.animate(0, "rotation", {0, 1, 2}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0});
    const auto loads = [&](std::size_t keyframes) {
        ModelLimits limits;
        limits.keyframes = keyframes;
        try {
            (void)parseGltf(maker.glb(), "test.glb", {}, limits);
            return true;
        } catch (const ModelError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("keyframes"));
            return false;
        }
    };
    EXPECT_TRUE(loads(10))
        << "each of the five keyframes counts twice: when it is read and in the path";
    EXPECT_FALSE(loads(9));
    EXPECT_FALSE(loads(4));
}

TEST(GltfMotion, InvalidKeyframesAreRefused) {
    const std::string place = "test.glb: animations[0].channels[0]: ";
    const auto sampler = [](GltfMaker& m) -> nlohmann::json& {
        return m.root["animations"][0]["samplers"][0];
    };
    EXPECT_EQ(faultOf([&](GltfMaker& m) { sampler(m)["input"] = m.floats({1, 1}, 1); }),
              place + "the times must not be negative and must increase");
    EXPECT_EQ(faultOf([&](GltfMaker& m) { sampler(m)["input"] = m.floats({0, 1, 2}, 1); }),
              place + "the sampler must have 3 values, 1 for each time");
    EXPECT_EQ(faultOf([&](GltfMaker& m) { sampler(m)["input"] = m.floats({0, 2e6}, 1); }),
              place + "the times must be at most 1e6 seconds");
    EXPECT_EQ(
        faultOf([&](GltfMaker& m) { sampler(m)["output"] = m.floats({0, 0, 0, 0, 2e6, 0}, 3); }),
        place + "the values must be between -1e6 and 1e6");
    EXPECT_EQ(
        faultOf([&](GltfMaker& m) { sampler(m)["output"] = m.floats({0, 0, 0, 0, 2e4, 0}, 3); }),
        "test.glb: nodes[0]: the node moves farther than 10000 m from its parent");
    EXPECT_NE(faultOf([&](GltfMaker& m) { sampler(m)["output"] = 99; }), "");
    EXPECT_NE(faultOf([&](GltfMaker& m) {
                  m.root["animations"][0]["channels"][0]["target"]["node"] = 7;
              }),
              "");
    EXPECT_NE(faultOf([&](GltfMaker& m) { m.root["animations"][0]["channels"][0]["sampler"] = 7; }),
              "");
    EXPECT_NE(faultOf([&](GltfMaker& m) { m.animate(0, "rotation", {0}, {0, 0, 0, 0}); }), "");
}

}  // namespace
}  // namespace mfar
