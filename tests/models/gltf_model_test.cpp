#include "pipeline/models/gltf_model.h"
#include "tests/models/gltf_maker.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace mfar {
namespace {

using test::GltfMaker;
using test::modelOf;
using test::oneTriangle;
using test::richModel;

void expectNear(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    EXPECT_LT((a - b).norm(), 1e-6F) << a.transpose() << " is not " << b.transpose();
}

TEST(GltfModel, TheYAxisOfAModelBecomesTheZAxis) {
    const Model model = modelOf(oneTriangle());
    ASSERT_EQ(model.meshes.size(), 1U);
    ASSERT_EQ(model.materials.size(), 1U) << "the model must have the default material";
    const Mesh& mesh = model.meshes[0];
    ASSERT_EQ(mesh.triangles.size(), 1U);
    expectNear(mesh.positions[1], {1, 0, 0});
    expectNear(mesh.positions[2], {0, 0, 1});
    EXPECT_TRUE(mesh.normals.empty() && mesh.uvs.empty() && mesh.tangents.empty());
    EXPECT_EQ(model.materials[0].roughness, 1);
}

TEST(GltfModel, MaterialIsRead) {
    const Model model = modelOf(richModel());
    ASSERT_EQ(model.materials.size(), 1U);
    const Material& m = model.materials[0];
    EXPECT_EQ(m.baseColour, Eigen::Vector4f(0.5F, 0.25F, 1, 0.75F));
    EXPECT_EQ(m.metallic, 0.125F);
    EXPECT_EQ(m.roughness, 0.25F);
    EXPECT_EQ(m.emission, Eigen::Vector3f(0.5F, 0, 1));
    EXPECT_EQ(m.normalScale, 0.5F);
    EXPECT_EQ(m.alphaCutoff, 0.25F);
    EXPECT_TRUE(m.doubleSided);
    // The same image is used as colour and as data. So it gives two textures.
    ASSERT_EQ(model.textures.size(), 2U);
    EXPECT_EQ(m.baseColourTexture, m.emissionTexture);
    EXPECT_EQ(m.normalTexture, m.metallicRoughnessTexture);
    EXPECT_TRUE(model.textures[m.baseColourTexture].srgb);
    EXPECT_FALSE(model.textures[m.normalTexture].srgb);
    const SurfaceTexture& texture = model.textures[m.baseColourTexture];
    EXPECT_EQ(texture.size, (Size{2, 2}));
    EXPECT_EQ(texture.texels[1], (std::array<std::uint8_t, 4>{0, 255, 0, 10}))
        << "alpha must be kept";
}

TEST(GltfModel, HierarchyIsApplied) {
    const Model model = modelOf(richModel());
    const Mesh& mesh = model.meshes.at(0);
    expectNear(mesh.positions[0], {0, -2, 0});
    expectNear(mesh.positions[2], {2, -2, 2});
    expectNear(mesh.normals[0], {0, -1, 0});
}

// The picture stands upright on the quad with u along +x. So tangents point along +x, bitangents
// along +z (up).
TEST(GltfModel, MissingTangentsAreComputed) {
    const Mesh mesh = modelOf(richModel()).meshes.at(0);
    ASSERT_EQ(mesh.tangents.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector3f t = mesh.tangents[i].head<3>();
        expectNear(t, {1, 0, 0});
        expectNear(mesh.normals[i].cross(t) * mesh.tangents[i].w(), {0, 0, 1});
    }
}

TEST(GltfModel, MirroredNodesKeepTheirFrontFaces) {
    GltfMaker maker = richModel();
    maker.root["nodes"][1]["scale"] = {-1, 1, 1};
    const Mesh mesh = modelOf(maker).meshes.at(0);
    const auto& [a, b, c] = mesh.triangles[0];
    const Eigen::Vector3f front = (mesh.positions[b] - mesh.positions[a])
                                      .cross(mesh.positions[c] - mesh.positions[a])
                                      .normalized();
    expectNear(front, {0, -1, 0});
    expectNear(mesh.normals[a], {0, -1, 0});
    const Eigen::Vector3f t = mesh.tangents[a].head<3>();
    expectNear(t, {-1, 0, 0});
    expectNear(mesh.normals[a].cross(t) * mesh.tangents[a].w(), {0, 0, 1});
}

TEST(GltfModel, NormalsAreCorrectAfterUnequalScaling) {
    GltfMaker maker = richModel();
    maker.root["nodes"][1].erase("scale");
    // The columns of a matrix with shear: x stays, y leans towards z, z is stretched.
    maker.root["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 4, 0, 0, 0, 0, 1};
    const Mesh mesh = modelOf(maker).meshes.at(0);
    const auto& [a, b, c] = mesh.triangles[0];
    const Eigen::Vector3f front = (mesh.positions[b] - mesh.positions[a])
                                      .cross(mesh.positions[c] - mesh.positions[a])
                                      .normalized();
    expectNear(mesh.normals[a], front);
}

TEST(GltfModel, RotationsTurnInTheRightDirection) {
    GltfMaker maker = oneTriangle();
    const double half = std::sqrt(0.5);
    maker.root["nodes"][0]["rotation"] = {0, 0, half, half};
    const Mesh mesh = modelOf(maker).meshes.at(0);
    expectNear(mesh.positions[1], {0, 0, 1});
    expectNear(mesh.positions[2], {-1, 0, 0});
}

TEST(GltfModel, StripsAndFansHaveConsistentWinding) {
    for (const int mode : {5, 6}) {
        GltfMaker maker;
        const std::vector<float> strip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0},
                                 fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
        maker.mesh(maker.floats(mode == 5 ? strip : fan, 3))["mode"] = mode;
        const Mesh mesh = modelOf(maker).meshes.at(0);
        ASSERT_EQ(mesh.triangles.size(), 2U);
        for (const auto& [a, b, c] : mesh.triangles)
            expectNear((mesh.positions[b] - mesh.positions[a])
                           .cross(mesh.positions[c] - mesh.positions[a]),
                       {0, -1, 0});
    }
}

TEST(GltfModel, SparseElementsAreReplaced) {
    GltfMaker maker = oneTriangle();
    const std::uint8_t index = 2;
    const std::array<float, 3> value = {0, 5, 0};
    maker.root["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", maker.view(&index, 1)}, {"componentType", 5121}}},
        {"values", {{"bufferView", maker.view(value.data(), sizeof value)}}}};
    expectNear(modelOf(maker).meshes.at(0).positions[2], {0, 0, 5});
    maker.root["accessors"][0].erase("bufferView");
    const Mesh zeros = modelOf(maker).meshes.at(0);
    expectNear(zeros.positions[1], {0, 0, 0});
    expectNear(zeros.positions[2], {0, 0, 5});
}

TEST(GltfModel, InterleavedAndNormalizedElementsAreRead) {
    GltfMaker maker = richModel();
    // Four elements of two shorts, with four unrelated bytes after each element.
    const std::array<std::uint16_t, 16> uvs = {0,     65535, 9, 9, 65535, 65535, 9, 9,
                                               65535, 0,     9, 9, 0,     0,     9, 9};
    const int view = maker.view(uvs.data(), sizeof uvs - 4);
    maker.root["bufferViews"][view]["byteStride"] = 8;
    maker.root["accessors"].push_back({{"bufferView", view},
                                       {"componentType", 5123},
                                       {"normalized", true},
                                       {"count", 4},
                                       {"type", "VEC2"}});
    maker.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        maker.root["accessors"].size() - 1;
    const Mesh mesh = modelOf(maker).meshes.at(0);
    EXPECT_EQ(mesh.uvs[1], Eigen::Vector2f(1, 1));
    EXPECT_EQ(mesh.uvs[3], Eigen::Vector2f(0, 0));
}

// Example from the specification of KHR_texture_transform: the lower left quarter of the picture,
// rotated.
TEST(GltfModel, TextureTransformIsApplied) {
    GltfMaker maker = richModel();
    nlohmann::json& m = maker.root["materials"][0];
    const nlohmann::json transform = {
        {"KHR_texture_transform",
         {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}}}};
    for (nlohmann::json* info : {&m["pbrMetallicRoughness"]["baseColorTexture"],
                                 &m["pbrMetallicRoughness"]["metallicRoughnessTexture"],
                                 &m["normalTexture"], &m["emissiveTexture"]})
        (*info)["extensions"] = transform;
    const Mesh mesh = modelOf(maker).meshes.at(0);
    for (const Eigen::Vector2f& uv : mesh.uvs) {
        EXPECT_TRUE(uv.x() >= -1e-6F && uv.x() <= 0.500001F) << uv.transpose();
        EXPECT_TRUE(uv.y() >= 0.499999F && uv.y() <= 1.000001F) << uv.transpose();
    }
}

TEST(GltfModel, EmissionStrengthIsApplied) {
    GltfMaker maker = richModel();
    maker.root["materials"][0]["extensions"] = {
        {"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}};
    expectNear(modelOf(maker).materials.at(0).emission, {4, 0, 8});
}

TEST(GltfModel, AlphaBlendingBecomesAMask) {
    GltfMaker maker = richModel();
    maker.root["materials"][0]["alphaMode"] = "BLEND";
    EXPECT_EQ(modelOf(maker).materials.at(0).alphaCutoff, 0.5F);
    maker.root["materials"][0].erase("alphaMode");
    EXPECT_EQ(modelOf(maker).materials.at(0).alphaCutoff, 0);
}

TEST(GltfModel, AnAlphaCutoffAboveOneIsAccepted) {
    GltfMaker maker = richModel();
    for (const double cutoff : {1.5, 1e300}) {
        maker.root["materials"][0]["alphaCutoff"] = cutoff;
        const float found = modelOf(maker).materials.at(0).alphaCutoff;
        EXPECT_TRUE(found > 1 && std::isfinite(found)) << found;
    }
}

TEST(GltfModel, TwoNodesMayUseTheSameMesh) {
    GltfMaker maker = oneTriangle();
    maker.root["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}});
    maker.root["scenes"][0]["nodes"].push_back(1);
    const Model model = modelOf(maker);
    ASSERT_EQ(model.meshes.size(), 2U);
    EXPECT_EQ(model.materials.size(), 1U);
    expectNear(model.meshes[1].positions[0], {5, 0, 0});
}

TEST(GltfModel, AModelWithoutMotionHasNoNotes) {
    EXPECT_TRUE(modelOf(richModel()).notes.empty());
}

TEST(GltfModel, SkinsAndMorphTargetsAreNotedWithTheirPathInTheFile) {
    GltfMaker maker = richModel();
    maker.root["skins"] = {{{"joints", {0}}}};
    nlohmann::json& part = maker.root["meshes"][0]["primitives"][0];
    part["targets"] = {{{"POSITION", part["attributes"]["POSITION"]}}};
    const std::vector<std::string> notes = modelOf(maker).notes;
    ASSERT_EQ(notes.size(), 2U);
    EXPECT_EQ(notes[0], "test.glb: skins[0]: skins are not applied; the mesh is shown as if it had "
                        "no skeleton");
    EXPECT_EQ(notes[1], "test.glb: meshes[0].primitives[0].targets: morph targets are not applied; "
                        "the mesh is shown without them");
    EXPECT_EQ(modelOf(maker).meshes.size(), modelOf(richModel()).meshes.size());
}

TEST(GltfModel, FilesInTheModelsFolderAreRead) {
    const test::TempFolder folder;
    GltfMaker maker = richModel();
    const auto write = [&](const std::string& name, const void* bytes, std::size_t count) {
        std::ofstream(folder.path() / name, std::ios::binary)
            .write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
    };
    const std::vector<std::uint8_t> png = test::rgbaPng({1, 1}, {{{1, 2, 3, 255}}});
    write("a b.png", png.data(), png.size());
    maker.root["images"][0] = {{"uri", "a%20b.png"}};
    write("data.bin", maker.bin().data(), maker.bin().size());
    const std::string text = maker.gltf();
    write("model.gltf", text.data(), text.size());
    const Model model = loadGltf(folder.path() / "model.gltf");
    EXPECT_EQ(model.textures.at(0).size, (Size{1, 1}));
    expectNear(model.meshes.at(0).positions[2], {2, -2, 2});
}

}  // namespace
}  // namespace mfar
