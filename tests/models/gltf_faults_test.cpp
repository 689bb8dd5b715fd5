#include "pipeline/models/gltf_model.h"
#include "tests/models/gltf_maker.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <limits>

namespace mfar {
namespace {

using nlohmann::json;
using test::GltfMaker;
using test::oneTriangle;
using test::richModel;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string faultOf(const std::function<void()>& act) {
    try {
        act();
        return "none";
    } catch (const ModelError& error) {
        return error.what();
    }
}

std::string faultOf(const GltfMaker& maker, const ModelLimits& limits = {}) {
    return faultOf([&] { (void)parseGltf(maker.glb(), "test.glb", {}, limits); });
}

std::string faultAfter(const std::function<void(json&)>& change) {
    GltfMaker maker = richModel();
    change(maker.root);
    return faultOf(maker);
}

auto saysAt(const std::string& place, const std::string& what) {
    return AllOf(StartsWith("test.glb: " + place), HasSubstr(what), Not(HasSubstr("\n")));
}

TEST(GltfFaults, ValidModelsHaveNoFaults) {
    EXPECT_EQ(faultOf(oneTriangle()), "none");
    EXPECT_EQ(faultOf(richModel()), "none");
}

TEST(GltfFaults, BytesThatAreNotAModelAreRefused) {
    const auto faultOfBytes = [](std::vector<std::uint8_t> bytes) {
        return faultOf([&] { (void)parseGltf(bytes, "test.glb"); });
    };
    EXPECT_EQ(faultOfBytes({}), "test.glb: is empty");
    EXPECT_THAT(faultOfBytes({'g', 'l', 'T', 'F'}), HasSubstr("ends within the .glb header"));
    EXPECT_THAT(faultOfBytes({'h', 'e', 'l', 'l', 'o'}),
                StartsWith("test.glb: is not a glTF file: "));
    EXPECT_THAT(faultOfBytes({'[', '1', ',', '2', ']'}), HasSubstr("the JSON must be an object"));
    std::vector<std::uint8_t> glb = oneTriangle().glb();
    glb[4] = 1;
    EXPECT_THAT(faultOfBytes(glb), HasSubstr("version 1"));
    glb = richModel().glb();
    for (std::size_t size = 0; size < glb.size(); size += 7)
        EXPECT_THAT(faultOfBytes({glb.begin(), glb.begin() + static_cast<std::ptrdiff_t>(size)}),
                    AllOf(StartsWith("test.glb: "), Not(HasSubstr("\n"))));
}

TEST(GltfFaults, DeeplyNestedJsonIsRefused) {
    const std::string deep =
        "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(100'000, '[') +
        std::string(100'000, ']') + "}";
    const std::vector<std::uint8_t> bytes(deep.begin(), deep.end());
    EXPECT_THAT(faultOf([&] { (void)parseGltf(bytes, "test.gltf"); }),
                HasSubstr("the JSON is nested more than"));
}

TEST(GltfFaults, InvalidBufferRangesAreRefused) {
    EXPECT_THAT(faultAfter([](json& r) { r["bufferViews"][1]["byteOffset"] = -4; }),
                saysAt("bufferViews[1]", "byteOffset must be a whole number"));
    EXPECT_THAT(faultAfter([](json& r) {
                    r["bufferViews"][1]["byteOffset"] = std::numeric_limits<std::uint64_t>::max();
                }),
                saysAt("bufferViews[1]", "reach beyond the buffer of"));
    EXPECT_THAT(faultAfter([](json& r) { r["bufferViews"][0]["byteLength"] = 1'000'000; }),
                saysAt("bufferViews[0]", "1000000 bytes at offset 0"));
    EXPECT_THAT(faultAfter([](json& r) { r["bufferViews"][0]["buffer"] = 7; }),
                saysAt("bufferViews[0]", "must name an existing buffer"));
    EXPECT_THAT(faultAfter([](json& r) { r["images"][0]["bufferView"] = 99; }),
                saysAt("images[0]", "must name an existing bufferView"));
    EXPECT_THAT(faultAfter([](json& r) { r["buffers"][0]["byteLength"] = 1e300; }),
                saysAt("buffers[0]", "must be a whole number, not negative"));
    EXPECT_THAT(faultAfter([](json& r) { r["buffers"][0] = 3; }),
                saysAt("buffers[0]", "must be an object"));
    EXPECT_THAT(faultAfter([](json& r) { r["nodes"] = "none"; }),
                saysAt("nodes", "must be a list"));
}

TEST(GltfFaults, InvalidAccessorRangesAreRefused) {
    const auto accessor = [](const char* key, const json& value) {
        return faultAfter([&](json& r) { r["accessors"][0][key] = value; });
    };
    const std::string place = "meshes[0].primitives[0].attributes.POSITION";
    EXPECT_THAT(accessor("byteOffset", 4), saysAt(place, "needs 48 bytes at offset 4"));
    EXPECT_THAT(accessor("byteOffset", std::numeric_limits<std::int64_t>::max()),
                saysAt(place, "needs 48 bytes"));
    EXPECT_THAT(accessor("count", 5), saysAt(place, "needs 60 bytes"));
    EXPECT_THAT(accessor("count", std::numeric_limits<std::int64_t>::max()),
                saysAt(place, "elements"));
    EXPECT_THAT(accessor("count", 0), StartsWith("test.glb: "));
    EXPECT_THAT(accessor("componentType", 5130), StartsWith("test.glb: "));
    EXPECT_THAT(accessor("type", "VEC2"), saysAt(place, "must have 3 numbers per element"));
    EXPECT_THAT(faultAfter([](json& r) { r["bufferViews"][0]["byteStride"] = 4; }),
                saysAt(place, "byteStride is 4"));
    EXPECT_THAT(
        faultAfter([](json& r) { r["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 12; }),
        saysAt(place, "index 12"));
}

TEST(GltfFaults, InvalidSparseAccessorsAreRefused) {
    const auto sparse = [](const char* key, const json& value) {
        GltfMaker maker = oneTriangle();
        const std::uint8_t index = 9;
        const std::array<float, 3> zeros{};
        json part = {{"count", 1},
                     {"indices", {{"bufferView", maker.view(&index, 1)}, {"componentType", 5121}}},
                     {"values", {{"bufferView", maker.view(zeros.data(), sizeof zeros)}}}};
        part[json::json_pointer(key)] = value;
        maker.root["accessors"][0]["sparse"] = part;
        return faultOf(maker);
    };
    EXPECT_THAT(sparse("/count", 1),
                HasSubstr("sparse index 9 is out of range; there are 3 elements"));
    EXPECT_THAT(sparse("/count", 2), HasSubstr("needs 2 bytes"));
    EXPECT_THAT(sparse("/count", -1), HasSubstr("invalid"));
    EXPECT_THAT(
        sparse("/indices/byteOffset", -1),
        saysAt("accessors[0].sparse.indices", "byteOffset must be a whole number, not negative"));
    EXPECT_THAT(sparse("/values/byteOffset", "8"),
                HasSubstr("must be a whole number, not negative"));
    EXPECT_THAT(sparse("/values", 3), HasSubstr("must be an object"));
    EXPECT_THAT(sparse("/values/byteOffset", 8), HasSubstr("needs 12 bytes at offset 8"));
    EXPECT_THAT(sparse("/indices/bufferView", 77), HasSubstr("index 77"));
    EXPECT_THAT(sparse("/indices/componentType", 5126), HasSubstr("invalid"));
}

TEST(GltfFaults, InvalidVerticesAndIndicesAreRefused) {
    GltfMaker maker = oneTriangle();
    maker.mesh(maker.floats({0, 0, NAN, 1, 0, 0, 0, 1, 0}, 3));
    EXPECT_THAT(faultOf(maker), HasSubstr("meshes[1].primitives[0].attributes.POSITION: element 0"
                                          " is not finite"));
    maker = oneTriangle();
    maker.mesh(maker.floats({0, 0, 0, 1e30F, 0, 0, 0, 1, 0}, 3));
    EXPECT_THAT(faultOf(maker), saysAt("nodes[1]", "farther than 10000 m"));
    maker = oneTriangle();
    maker.root["meshes"][0]["primitives"][0]["indices"] = maker.shorts({0, 1, 3});
    EXPECT_THAT(faultOf(maker), saysAt("meshes[0].primitives[0].indices",
                                       "index 3 is out of range; there are 3 vertices"));
    maker.root["meshes"][0]["primitives"][0]["indices"] = maker.shorts({0, 1, 2, 0});
    EXPECT_THAT(faultOf(maker), HasSubstr("a multiple of 3 indices, but found 4"));
    maker = oneTriangle();
    maker.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = maker.floats({0, 0, 1}, 3);
    EXPECT_THAT(faultOf(maker), saysAt("meshes[0].primitives[0]", "1 normals for 3 vertices"));
}

TEST(GltfFaults, InvalidNodesAreRefused) {
    EXPECT_THAT(faultAfter([](json& r) { r["nodes"][0]["children"] = {1}; }),
                saysAt("nodes[1]", "its own ancestor"));
    EXPECT_THAT(faultAfter([](json& r) { r["nodes"][1]["children"] = {5}; }),
                saysAt("nodes[5]", "index 5"));
    EXPECT_THAT(faultAfter([](json& r) { r["nodes"][1]["rotation"] = {0, 0, 0, 0}; }),
                saysAt("nodes[1]", "rotation"));
    EXPECT_THAT(faultAfter([](json& r) { r["nodes"][1]["scale"] = {1, 2}; }),
                saysAt("nodes[1]", "matrix must have 16 numbers"));
    EXPECT_THAT(faultAfter([](json& r) { r["nodes"][1]["scale"] = {1e308, 1e308, 1e308}; }),
                saysAt("nodes[", "farther"));
    EXPECT_THAT(faultAfter([](json& r) { r["nodes"][0]["mesh"] = 3; }),
                saysAt("nodes[0].mesh", "index 3"));
    EXPECT_THAT(faultAfter([](json& r) { r["scene"] = 4; }), saysAt("scene", "index 4"));
    EXPECT_THAT(faultAfter([](json& r) { r["nodes"][0].erase("mesh"); }),
                saysAt("scene", "no triangles"));
    GltfMaker maker = oneTriangle();
    for (int i = 0; i < 70; ++i)
        maker.root["nodes"].push_back({{"children", {i}}});
    maker.root["scenes"][0]["nodes"] = {70};
    EXPECT_THAT(faultOf(maker), HasSubstr("nested more than 64 levels deep"));
}

// Each level of the tree contains the next level twice. So there are 2^40 instances.
TEST(GltfFaults, EveryInstanceOfANodeIsCounted) {
    GltfMaker maker = oneTriangle();
    for (int i = 0; i < 40; ++i)
        maker.root["nodes"].push_back({{"children", {i, i}}});
    maker.root["scenes"][0]["nodes"] = {40};
    EXPECT_THAT(faultOf(maker), HasSubstr("more than 100000 nodes"));
}

TEST(GltfFaults, InvalidMaterialsAreRefused) {
    const auto material = [](const char* key, const json& value) {
        return faultAfter([&](json& r) { r["materials"][0][json::json_pointer(key)] = value; });
    };
    EXPECT_THAT(material("/pbrMetallicRoughness/roughnessFactor", -1),
                saysAt("materials[0].roughnessFactor", "must be from 0 to 1, not -1"));
    EXPECT_THAT(material("/pbrMetallicRoughness/baseColorFactor", {1, 2, 1, 1}),
                saysAt("materials[0].baseColorFactor", "must be from 0 to 1, not 2"));
    EXPECT_THAT(material("/alphaMode", "GLASS"), saysAt("materials[0].alphaMode", "GLASS"));
    EXPECT_THAT(material("/alphaCutoff", -1),
                saysAt("materials[0].alphaCutoff", "must be at least 0, not -1"));
    EXPECT_THAT(material("/normalTexture/index", 9), saysAt("materials[0].normalTexture", "9"));
    EXPECT_THAT(material("/emissiveTexture/texCoord", 1), HasSubstr("the same texCoord"));
    EXPECT_THAT(material("/extensions/KHR_materials_emissive_strength/emissiveStrength", -2),
                saysAt("materials[0].emissiveStrength", "-2"));
    EXPECT_THAT(faultAfter([](json& r) { r["meshes"][0]["primitives"][0]["material"] = 4; }),
                HasSubstr("index 4"));
    EXPECT_THAT(faultAfter([](json& r) { r["extensionsRequired"] = {"KHR_draco"}; }),
                saysAt("extensionsRequired", "KHR_draco"));
}

TEST(GltfFaults, InvalidPicturesAreRefused) {
    GltfMaker maker = richModel();
    const std::vector<std::uint8_t> noise(64, 7);
    maker.texture(noise, "image/png");
    maker.root["textures"][0]["source"] = 1;
    EXPECT_THAT(faultOf(maker), saysAt("images[1]", "neither PNG nor JPEG"));
    EXPECT_THAT(faultAfter([](json& r) { r["textures"][0]["source"] = 8; }), HasSubstr("index 8"));
    ModelLimits limits;
    limits.textureSide = 1;
    EXPECT_THAT(faultOf(richModel(), limits), saysAt("images[0]", "2x2 pixels; at most 1"));
    limits = {};
    limits.texels = 7;
    EXPECT_THAT(faultOf(richModel(), limits), saysAt("images[0]", "more than 7 pixels"));
    limits = {};
    limits.textures = 1;
    EXPECT_THAT(faultOf(richModel(), limits), HasSubstr("more than 1 textures"));
}

TEST(GltfFaults, ModelsBeyondTheLimitsAreRefused) {
    ModelLimits limits;
    limits.vertices = 3;
    EXPECT_THAT(faultOf(richModel(), limits), HasSubstr("4 elements; 1 to 3 are supported"));
    limits = {};
    limits.triangles = 1;
    EXPECT_THAT(faultOf(richModel(), limits), StartsWith("test.glb: meshes[0].primitives[0]"));
    limits = {};
    limits.bytes = 200;
    EXPECT_THAT(faultOf(richModel(), limits), HasSubstr("the limit is 200 bytes"));
    limits = {};
    limits.elements = 3;
    EXPECT_THAT(faultOf(richModel(), limits), saysAt("accessors", "4 entries; at most 3"));
    GltfMaker maker = oneTriangle();
    maker.root["scenes"][0]["nodes"] = {0, 0};
    limits = {};
    limits.vertices = 5;
    EXPECT_THAT(faultOf(maker, limits), HasSubstr("more than 5 vertices"));
    limits = {};
    limits.triangles = 1;
    EXPECT_THAT(faultOf(maker, limits), HasSubstr("more than 1 triangles"));
}

TEST(GltfFaults, RepeatedBuffersCountTowardsTheLimit) {
    GltfMaker maker = richModel();
    ModelLimits limits;
    for (int i = 0; i < 100; ++i)
        maker.root["buffers"].push_back(maker.root["buffers"][0]);
    limits.bytes = maker.glb().size() + maker.bin().size();
    EXPECT_THAT(faultOf(maker, limits), HasSubstr("all buffers together exceed the limit of"));
}

class GltfFiles : public testing::Test {
protected:
    GltfFiles() {
        std::filesystem::create_directory(folder_.path() / "model");
        write("secret.bin", std::string(maker_.bin().begin(), maker_.bin().end()));
        write("model/data.bin", std::string(maker_.bin().begin(), maker_.bin().end()));
    }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.path() / name, std::ios::binary) << text;
    }

    std::string faultWithUri(const std::string& uri) {
        json root = json::parse(maker_.gltf());
        root["buffers"][0]["uri"] = uri;
        write("model/test.gltf", root.dump());
        return faultOf([&] { (void)loadGltf(folder_.path() / "model" / "test.gltf"); });
    }

    GltfMaker maker_ = oneTriangle();
    test::TempFolder folder_;
};

TEST_F(GltfFiles, OnlyFilesInTheModelsFolderAreRead) {
    EXPECT_EQ(faultWithUri("data.bin"), "none");
    EXPECT_EQ(faultWithUri("./data.bin"), "none");
    EXPECT_THAT(faultWithUri("../secret.bin"), HasSubstr("folder"));
    EXPECT_THAT(faultWithUri("..%2Fsecret.bin"), HasSubstr("folder"));
    EXPECT_THAT(faultWithUri((folder_.path() / "secret.bin").string()), HasSubstr("folder"));
    EXPECT_THAT(faultWithUri("http://example.org/data.bin"), HasSubstr("missing"));
    EXPECT_THAT(faultWithUri("none.bin"), HasSubstr("missing"));
    EXPECT_THAT(faultWithUri("."), HasSubstr("not a regular file"));
    std::filesystem::create_symlink(folder_.path() / "secret.bin",
                                    folder_.path() / "model" / "link.bin");
    EXPECT_THAT(faultWithUri("link.bin"), HasSubstr("folder"));
}

TEST_F(GltfFiles, AModelInMemoryThatNamesFilesIsRefused) {
    const std::string text = maker_.gltf();
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    EXPECT_THAT(faultOf([&] { (void)parseGltf(bytes, "test.gltf"); }),
                HasSubstr("references to other files are not allowed"));
}

TEST_F(GltfFiles, MissingModelsAndBufferFilesOfAnotherSizeAreRefused) {
    write("model/data.bin", "short");
    EXPECT_THAT(faultWithUri("data.bin"), HasSubstr("mismatch"));
    EXPECT_THAT(faultOf([&] { (void)loadGltf(folder_.path() / "none.glb"); }),
                HasSubstr("none.glb: is missing"));
    EXPECT_THAT(faultOf([&] { (void)loadGltf(folder_.path()); }), HasSubstr("not a regular file"));
}

}  // namespace
}  // namespace mfar
