#include "hal/virtual/synthetic_light.h"
#include "hal/virtual/synthetic_store.h"
#include "hal/virtual/synthetic_textures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace mfar::synthetic {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 16;

class SyntheticStore : public testing::Test {
protected:
    SyntheticStore() { fs::remove_all(folder_); }
    ~SyntheticStore() override { fs::remove_all(folder_); }

    /// Returns the stored texels of `key`. If there are none, stores and returns texels of the
    /// value `colour`.
    cv::Mat4b get(std::uint64_t key, unsigned char colour) {
        return TexelStore(folder_).get(key, kSide, [&] {
            ++made_;
            return cv::Mat4b(kSide, kSide, cv::Vec4b::all(colour));
        });
    }

    std::vector<fs::path> files() const {
        std::vector<fs::path> out;
        for (const auto& entry : fs::directory_iterator(folder_))
            out.push_back(entry.path());
        return out;
    }

    fs::path folder_ = fs::path(testing::TempDir()) / "mfar_synthetic_store";
    int made_ = 0;
};

bool same(const cv::Mat4b& a, const cv::Mat4b& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

std::string contents(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(SyntheticStore, TexelsAreComputedOncePerKey) {
    EXPECT_EQ(get(1, 10)(3, 5), cv::Vec4b::all(10));
    EXPECT_EQ(get(2, 20)(3, 5), cv::Vec4b::all(20));
    EXPECT_EQ(made_, 2);
    EXPECT_EQ(get(1, 99)(3, 5), cv::Vec4b::all(10));
    EXPECT_EQ(get(2, 99)(3, 5), cv::Vec4b::all(20));
    EXPECT_EQ(made_, 2);
}

TEST_F(SyntheticStore, BrokenFilesAreReplaced) {
    (void)get(1, 10);
    const fs::path file = files().at(0);
    const std::string whole = contents(file);
    std::string flipped = whole;
    flipped[100] = static_cast<char>(flipped[100] ^ 1);
    std::string otherSum = whole;
    otherSum.back() = static_cast<char>(otherSum.back() ^ 1);
    for (const std::string& broken :
         {std::string(), whole.substr(1), whole + "x", flipped, otherSum}) {
        write(file, broken);
        made_ = 0;
        EXPECT_EQ(get(1, 10)(3, 5), cv::Vec4b::all(10));
        EXPECT_EQ(made_, 1);
        EXPECT_EQ(contents(file), whole);
    }
}

TEST_F(SyntheticStore, FileOfAnotherKeyIsNotUsed) {
    (void)get(1, 10);
    const fs::path first = files().at(0);
    (void)get(2, 20);
    const fs::path second = files().at(0) == first ? files().at(1) : files().at(0);
    fs::copy_file(first, second, fs::copy_options::overwrite_existing);
    EXPECT_EQ(get(2, 20)(3, 5), cv::Vec4b::all(20));
}

TEST_F(SyntheticStore, TexelsAreComputedEachTimeIfTheFolderCannotBeCreated) {
    write(folder_, "a file, so that no folder can have this name");
    EXPECT_EQ(get(1, 10)(3, 5), cv::Vec4b::all(10));
    EXPECT_EQ(get(1, 10)(3, 5), cv::Vec4b::all(10));
    EXPECT_EQ(made_, 2);
}

TEST_F(SyntheticStore, FilesUsedLeastRecentlyAreRemoved) {
    for (int key = 0; key < TexelStore::kMostFiles; ++key)
        (void)get(key, 10);
    for (const fs::path& file : files())
        fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
    (void)get(7, 10);
    made_ = 0;
    for (int key = 0; key < 5; ++key)
        (void)get(100 + key, 10);
    EXPECT_EQ(files().size(), static_cast<std::size_t>(TexelStore::kMostFiles));
    EXPECT_EQ(made_, 5);
    (void)get(7, 10);
    EXPECT_EQ(made_, 5);
}

TEST_F(SyntheticStore, ManyThreadsStoreAndReadTheSameFiles) {
    std::vector<std::jthread> threads;
    std::atomic<int> wrong = 0;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&] {
            for (int i = 0; i < 100; ++i) {
                const auto colour = static_cast<unsigned char>(i % 10);
                const auto make = [&] { return cv::Mat4b(kSide, kSide, cv::Vec4b::all(colour)); };
                if (TexelStore(folder_).get(colour, kSide, make)(7, 7) != cv::Vec4b::all(colour))
                    ++wrong;
            }
        });
    }
    threads.clear();
    EXPECT_EQ(wrong, 0);
}

TEST_F(SyntheticStore, StoredLightMapsAndTexturesEqualTheComputedOnes) {
    const World world = makeWorld(Scene::Flat, 3);
    const cv::Mat4b light = bakeLight(world, TexelStore({})).texels;
    const TexelStore store(folder_);
    EXPECT_TRUE(same(bakeLight(world, store).texels, light));
    EXPECT_TRUE(same(bakeLight(world, store).texels, light));
    const cv::Mat4b tags = makeLayer(Layer::Tags, 3);
    const auto layer = [&] {
        return store.get(layerKey(Layer::Tags, 3), kLayerSize,
                         [] { return makeLayer(Layer::Tags, 3); });
    };
    EXPECT_TRUE(same(layer(), tags));
    EXPECT_TRUE(same(layer(), tags));
    EXPECT_EQ(files().size(), 2U);
}

TEST(SyntheticStoreKeys, DependOnEveryInput) {
    const World world = makeWorld(Scene::Office, 1);
    std::vector<std::uint64_t> keys{lightKey(world), layerKey(Layer::Wood, 1),
                                    layerKey(Layer::Wood, 2), layerKey(Layer::Bark, 1)};
    const auto add = [&](const auto& change) {
        World changed = world;
        change(changed);
        keys.push_back(lightKey(changed));
    };
    add([](World& w) { w.primitives[3].half.x() *= 2; });
    add([](World& w) { w.primitives[3].T_world_prim.translation.z() += 0.1; });
    add([](World& w) { w.primitives[3].T_world_prim.rotation.w() *= 0.5; });
    add([](World& w) { w.primitives[3].shape = Shape::Ellipsoid; });
    add([](World& w) { w.primitives[3].moves = true; });
    add([](World& w) { w.primitives[3].lightTexels += 1; });
    add([](World& w) { w.primitives.pop_back(); });
    add([](World& w) { w.materials[w.primitives[3].materials[1]].tint.y() *= 0.5; });
    add([](World& w) { w.light.spread *= 2; });
    add([](World& w) { w.light.key.x() *= 2; });
    add([](World& w) { w.light.ambient.x() *= 2; });
    add([](World& w) { w.light.towards.x() *= 2; });
    add([](World& w) { w.eye.x() += 1; });
    add([](World& w) { w.target.x() += 1; });
    std::ranges::sort(keys);
    EXPECT_EQ(std::ranges::adjacent_find(keys), keys.end());
}

}  // namespace
}  // namespace mfar::synthetic
