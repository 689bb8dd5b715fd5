// Feeds the glTF reader with damaged models: whatever it gets, it answers with a sound model or
// with ModelError. What it must not do (crash, hang, go out of bounds) the sanitizers see.
#include "pipeline/models/gltf_model.h"
#include "tests/fuzz/mutations.h"
#include "tests/fuzz/sound_model.h"
#include "tests/models/gltf_maker.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>

namespace mfar::test {
namespace {

using Clock = std::chrono::steady_clock;

/// Small, so that a damaged count is refused and not only slow.
ModelLimits smallLimits() {
    ModelLimits limits;
    limits.bytes = 1U << 20U;
    limits.vertices = limits.triangles = 10'000;
    limits.elements = 1'000;
    limits.texels = 1U << 16U;
    return limits;
}

std::vector<std::vector<std::uint8_t>> seedFiles() {
    GltfMaker strips;
    strips.mesh(strips.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, 3))["mode"] = 5;
    GltfMaker sparse = oneTriangle();
    const std::uint8_t index = 2;
    const std::array<float, 3> value = {0, 5, 0};
    sparse.root["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", sparse.view(&index, 1)}, {"componentType", 5121}}},
        {"values", {{"bufferView", sparse.view(value.data(), sizeof value)}}}};
    GltfMaker inText = oneTriangle();
    inText.root["buffers"][0]["uri"] =
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    const std::string text = inText.root.dump();
    return {oneTriangle().glb(),
            richModel().glb(),
            strips.glb(),
            sparse.glb(),
            {text.begin(), text.end()}};
}

struct Tally {
    std::uint64_t files = 0, sound = 0, refused = 0;
};

/// Throws std::runtime_error for a model that is not as its header says.
void readOne(const std::vector<std::uint8_t>& bytes, Tally& tally) {
    ++tally.files;
    try {
        requireSoundModel(parseGltf(bytes, "fuzz", {}, smallLimits()));
        ++tally.sound;
    } catch (const ModelError&) {
        ++tally.refused;
    }
}

int readFileGiven(const std::string& name) {
    std::ifstream in(name, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
    try {
        requireSoundModel(parseGltf(bytes, name, {}, smallLimits()));
        fmt::print("a sound model\n");
    } catch (const ModelError& error) {
        fmt::print("{}\n", error.what());
    }
    return 0;
}

/// The bytes are there when a sanitizer or a signal ends the process.
void keep(const std::vector<std::uint8_t>& bytes, const std::string& file) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

Tally fuzz(std::uint64_t seed, double seconds, const std::string& keepIn) {
    const std::vector<std::vector<std::uint8_t>> seeds = seedFiles();
    Mutations mutations(seed);
    Tally tally;
    const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                     std::chrono::duration<double>(seconds));
    while (Clock::now() < end) {
        const std::vector<std::uint8_t> bytes = mutations.next(seeds);
        if (!keepIn.empty()) keep(bytes, keepIn);
        try {
            readOne(bytes, tally);
        } catch (const std::exception&) {
            keep(bytes, keepIn.empty() ? "gltf_fuzz_case" : keepIn);
            fmt::print(stderr, "seed {}, file {}\n", seed, tally.files);
            throw;
        }
    }
    return tally;
}

}  // namespace
}  // namespace mfar::test

int main(int argc, char** argv) {
    std::uint64_t seed = 1;
    double seconds = 5;
    std::string file, keepIn;
    CLI::App app("Feeds the glTF reader with damaged models.");
    app.add_option("--seed", seed, "of what is damaged");
    app.add_option("--seconds", seconds, "to go on for")->check(CLI::Range(0.0, 86400.0));
    app.add_option("--file", file, "read this one instead");
    app.add_option("--keep", keepIn, "write each file here before it is read");
    CLI11_PARSE(app, argc, argv);
    try {
        if (!file.empty()) return mfar::test::readFileGiven(file);
        const mfar::test::Tally tally = mfar::test::fuzz(seed, seconds, keepIn);
        fmt::print("{} files: {} sound, {} refused\n", tally.files, tally.sound, tally.refused);
        // Damage that is never or always noticed tests nothing.
        return tally.sound > 0 && tally.refused > 0 ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
