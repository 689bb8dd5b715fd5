#include "tests/models/gltf_maker.h"

#include "pipeline/models/gltf_model.h"

#include <cstring>
#include <png.h>

namespace mfar::test {
namespace {

using nlohmann::json;

void append(std::vector<std::uint8_t>& out, const void* bytes, std::size_t count) {
    const auto* first = static_cast<const std::uint8_t*>(bytes);
    out.insert(out.end(), first, first + count);
}

void append(std::vector<std::uint8_t>& out, std::uint32_t value) {
    append(out, &value, sizeof value);
}

}  // namespace

GltfMaker::GltfMaker()
    : root(json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}],
                           "nodes": [], "meshes": [], "accessors": [], "bufferViews": [],
                           "buffers": [{"byteLength": 0}]})")) {}

int GltfMaker::view(const void* bytes, std::size_t count) {
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", count}});
    append(bin_, bytes, count);
    bin_.resize((bin_.size() + 3) / 4 * 4);
    root["buffers"][0]["byteLength"] = bin_.size();
    return static_cast<int>(root["bufferViews"].size()) - 1;
}

int GltfMaker::floats(const std::vector<float>& values, int components) {
    const std::array<const char*, 5> types = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    root["accessors"].push_back({{"bufferView", view(values.data(), values.size() * sizeof(float))},
                                 {"componentType", 5126},
                                 {"count", values.size() / components},
                                 {"type", types.at(components)}});
    return static_cast<int>(root["accessors"].size()) - 1;
}

int GltfMaker::shorts(const std::vector<std::uint16_t>& values) {
    root["accessors"].push_back({{"bufferView", view(values.data(), values.size() * 2)},
                                 {"componentType", 5123},
                                 {"count", values.size()},
                                 {"type", "SCALAR"}});
    return static_cast<int>(root["accessors"].size()) - 1;
}

int GltfMaker::texture(const std::vector<std::uint8_t>& file, const std::string& mime) {
    root["images"].push_back({{"bufferView", view(file.data(), file.size())}, {"mimeType", mime}});
    root["textures"].push_back({{"source", root["images"].size() - 1}});
    return static_cast<int>(root["textures"].size()) - 1;
}

json& GltfMaker::mesh(int positions, int indices) {
    json primitive = {{"attributes", {{"POSITION", positions}}}};
    if (indices >= 0) primitive["indices"] = indices;
    root["meshes"].push_back({{"primitives", json::array({primitive})}});
    root["nodes"].push_back({{"mesh", root["meshes"].size() - 1}});
    root["scenes"][0]["nodes"].push_back(root["nodes"].size() - 1);
    return root["meshes"].back()["primitives"][0];
}

json& GltfMaker::animate(int node, const std::string& path, const std::vector<float>& times,
                         const std::vector<float>& values) {
    json& animation = root["animations"][0];
    animation["samplers"].push_back(
        {{"input", floats(times, 1)}, {"output", floats(values, path == "rotation" ? 4 : 3)}});
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                     {"target", {{"node", node}, {"path", path}}}});
    return animation["samplers"].back();
}

std::vector<std::uint8_t> GltfMaker::glb() const {
    std::string text = root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::uint8_t> out;
    append(out, "glTF", 4);
    append(out, 2U);
    append(out, static_cast<std::uint32_t>(28 + text.size() + bin_.size()));
    append(out, static_cast<std::uint32_t>(text.size()));
    append(out, 0x4E4F534AU);
    append(out, text.data(), text.size());
    append(out, static_cast<std::uint32_t>(bin_.size()));
    append(out, 0x004E4942U);
    append(out, bin_.data(), bin_.size());
    return out;
}

std::string GltfMaker::gltf() const {
    json copy = root;
    copy["buffers"][0]["uri"] = "data.bin";
    return copy.dump();
}

Model modelOf(const GltfMaker& maker) {
    return parseGltf(maker.glb(), "test.glb");
}

GltfMaker oneTriangle() {
    GltfMaker maker;
    maker.mesh(maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3));
    return maker;
}

GltfMaker richModel() {
    GltfMaker maker;
    const int positions = maker.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
    json& quad = maker.mesh(positions, maker.shorts({0, 1, 2, 0, 2, 3}));
    quad["attributes"]["NORMAL"] = maker.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    quad["attributes"]["TEXCOORD_0"] = maker.floats({0, 1, 1, 1, 1, 0, 0, 0}, 2);
    quad["material"] = 0;
    const int texture = maker.texture(
        rgbaPng({2, 2}, {{{255, 0, 0, 255}}, {{0, 255, 0, 10}}, {{0, 0, 255, 255}}, {}}),
        "image/png");
    const json info = {{"index", texture}};
    maker.root["materials"] = {{{"pbrMetallicRoughness",
                                 {{"baseColorFactor", {0.5, 0.25, 1, 0.75}},
                                  {"metallicFactor", 0.125},
                                  {"roughnessFactor", 0.25},
                                  {"baseColorTexture", info},
                                  {"metallicRoughnessTexture", info}}},
                                {"normalTexture", {{"index", texture}, {"scale", 0.5}}},
                                {"emissiveTexture", info},
                                {"emissiveFactor", {0.5, 0, 1}},
                                {"alphaMode", "MASK"},
                                {"alphaCutoff", 0.25},
                                {"doubleSided", true}}};
    maker.root["nodes"][0]["translation"] = {0, 0, 1};
    maker.root["nodes"].push_back({{"children", {0}}, {"scale", {2, 2, 2}}});
    maker.root["scenes"][0]["nodes"] = {1};
    return maker;
}

std::vector<std::uint8_t> rgbaPng(Size size,
                                  const std::vector<std::array<std::uint8_t, 4>>& texels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(size.width);
    image.height = static_cast<png_uint_32>(size.height);
    image.format = PNG_FORMAT_RGBA;
    png_alloc_size_t bytes = 0;
    png_image_write_to_memory(&image, nullptr, &bytes, 0, texels.data(), 0, nullptr);
    std::vector<std::uint8_t> out(bytes);
    png_image_write_to_memory(&image, out.data(), &bytes, 0, texels.data(), 0, nullptr);
    out.resize(bytes);
    return out;
}

}  // namespace mfar::test
