#include "tests/engine/gl_test.h"
#include "tests/warp/warp_support.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace mfar {
namespace {

using WarpThreadsGl = GlTest;

constexpr const char* kHashFile = "MFAR_WARP_HASH_OUT";

template <class T>
std::uint64_t hashed(std::uint64_t hash, const std::vector<T>& values) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i)
        hash = (hash ^ bytes[i]) * 1099511628211U;
    return hash;
}

std::uint64_t hashOfWarps(int threads) {
    std::uint64_t hash = 14695981039346656037U;
    const Size size{320, 240};
    const test::CastScene scene = test::twoBalls();
    const auto engine = test::warpEngine(EngineChoice::fromEnvironment().occlusion, threads);
    Warp warp(test::bentCamera(size), size, *engine);
    warp.setScene(scene.scene());
    warp.setTracedPicture(tracedPicture(scene.cast({warp.camera(), test::orbit(0)})));
    for (const double degrees : {1.0, 7.0, 25.0}) {
        const RigidTransform pose = test::orbit(degrees);
        const LayerPicture& layer = test::settled(warp, scene, pose);
        hash = hashed(hash, test::bytesOf(layer.colour));
        hash = hashed(hash, test::valuesOf(layer.depth));
    }
    return hash;
}

TEST_F(WarpThreadsGl, WritesTheHashOfItsPicture) {
    const char* file = std::getenv(kHashFile);
    if (file == nullptr)
        GTEST_SKIP() << "only WarpThreads.PicturesAreEqualWithOneAndTwoThreads runs this test";
    std::ofstream(file) << hashOfWarps(std::atoi(std::getenv("LP_NUM_THREADS")));
}

TEST(WarpThreads, PicturesAreEqualWithOneAndTwoThreads) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    std::string hashes[2];
    for (int threads = 1; threads <= 2; ++threads) {
        const std::string file = testing::TempDir() + "warp_hash_" + std::to_string(::getpid());
        std::ostringstream command;
        command << kHashFile << "='" << file << "' LP_NUM_THREADS=" << threads
                << " GTEST_TOTAL_SHARDS=1 GTEST_SHARD_INDEX=0 '" << program
                << "' --gtest_filter=WarpThreadsGl.WritesTheHashOfItsPicture >/dev/null";
        ASSERT_EQ(std::system(command.str().c_str()), 0);
        std::ifstream(file) >> hashes[threads - 1];
        std::filesystem::remove(file);
    }
    EXPECT_FALSE(hashes[0].empty());
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace mfar
