#include "tests/engine/gl_test.h"
#include "tests/engine/gles/pipeline_case.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace mfar {
namespace {

using AcrossGl = GlTest;

// kDifferentShare: upper limit of the share of bytes that differ by more than one grey level.
// kLargest: upper limit of the difference of any byte. The renderers round in the same way, but may
// add numbers in a different order.
constexpr double kDifferentShare = 1e-4;
constexpr int kLargest = 4;

std::vector<std::uint8_t> pipelinePictures() {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setStill(c.still().view(), {});
    std::vector<std::uint8_t> out;
    for (const SuperResMode mode : {SuperResMode::Off, SuperResMode::Blend, SuperResMode::Detail}) {
        p.setMode(mode);
        p.run(c.video({2.3, -1.4}).view(), {});
        const auto image = p.readImage();
        out.insert(out.end(), image.begin(), image.end());
    }
    return out;
}

/// CTest runs this test twice. With the first GL it writes the file MFAR_PICTURES_OUT, with the
/// second it reads the file MFAR_PICTURES_IN.
TEST_F(AcrossGl, TwoGlRenderersDrawTheSamePictures) {
    const char* out = std::getenv("MFAR_PICTURES_OUT");
    const char* in = std::getenv("MFAR_PICTURES_IN");
    if (out == nullptr && in == nullptr)
        GTEST_SKIP() << "only CTest runs this test; it sets MFAR_PICTURES_OUT or MFAR_PICTURES_IN";
    const auto mine = pipelinePictures();
    if (out != nullptr) {
        std::ofstream file(out, std::ios::binary | std::ios::trunc);
        file.write(reinterpret_cast<const char*>(mine.data()),
                   static_cast<std::streamsize>(mine.size()));
        ASSERT_TRUE(file.good()) << out;
        return;
    }
    std::ifstream file(in, std::ios::binary);
    const std::string theirs{std::istreambuf_iterator<char>(file), {}};
    ASSERT_EQ(theirs.size(), mine.size()) << in;
    std::size_t different = 0;
    int largest = 0;
    for (std::size_t i = 0; i < mine.size(); ++i) {
        const int d = std::abs(mine[i] - static_cast<std::uint8_t>(theirs[i]));
        different += d > 1 ? 1 : 0;
        largest = std::max(largest, d);
    }
    EXPECT_LE(static_cast<double>(different), kDifferentShare * static_cast<double>(mine.size()));
    EXPECT_LE(largest, kLargest);
    std::printf("%zu of %zu bytes differ by more than 1, at most by %d\n", different, mine.size(),
                largest);
}

}  // namespace
}  // namespace mfar
