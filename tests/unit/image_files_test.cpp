#include "hal/virtual/image_files.h"
#include "tests/unit/small_recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <utility>

namespace mfar {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;
using test::writeFile;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

template <class F>
std::string errorOf(F&& f) {
    try {
        f();
    } catch (const ImageFileError& e) {
        return e.what();
    }
    return "no error";
}

/// A picture with padded rows, in which neighbouring bytes differ.
struct Padded {
    Padded(Size size, PixelFormat format) {
        const std::size_t stride = static_cast<std::size_t>(size.width) * bytesPerPixel(format) + 5;
        bytes.resize(stride * size.height);
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = static_cast<std::uint8_t>(i * 7);
        view = {bytes.data(), size, stride, format};
    }
    std::vector<std::uint8_t> bytes;
    ImageView view;
};

TEST(ImageFiles, ALargeProgressiveJpegIsRefusedAtItsHeader) {
    const TempFolder folder;
    std::string bytes = test::readFile(MFAR_PROGRESSIVE_JPEG);
    const std::size_t frame = bytes.find("\xff\xc2");
    ASSERT_NE(frame, bytes.npos);
    bytes.replace(frame + 5, 4, std::string("\x20\x00\x20\x00", 4));
    test::writeFile(folder / "a.jpg", bytes);
    const std::string error = errorOf([&] { static_cast<void>(loadImage(folder / "a.jpg")); });
    EXPECT_NE(error.find("a progressive JPEG may have at most"), error.npos) << error;
    EXPECT_EQ(loadImage(MFAR_PROGRESSIVE_JPEG).size, (Size{16, 8}));
    // Bytes 0xff before a marker have no meaning.
    bytes.insert(2, "\xff\xff");
    test::writeFile(folder / "a.jpg", bytes);
    EXPECT_EQ(errorOf([&] { static_cast<void>(loadImage(folder / "a.jpg")); }), error);
}

TEST(ImageFiles, PngKeepsColoursButNotAlpha) {
    const TempFolder folder;
    const Padded source({5, 3}, PixelFormat::Rgba8);
    savePng(folder / "a.png", source.view);
    const StoredImage read = loadImage(folder / "a.png");
    ASSERT_EQ(read.size, (Size{5, 3}));
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x)
            for (int c = 0; c < 4; ++c) {
                const std::uint8_t expected =
                    c == 3 ? 255 : source.view.data[y * source.view.stride + 4 * x + c];
                EXPECT_EQ(read.pixels[(y * 5 + x) * 4 + c], expected) << x << ',' << y << ',' << c;
            }
}

TEST(ImageFiles, RgbaAndBgraPicturesGiveTheSamePng) {
    const Padded source({5, 3}, PixelFormat::Rgba8);
    Padded swapped = source;
    swapped.view = {swapped.bytes.data(), {5, 3}, source.view.stride, PixelFormat::Bgra8};
    for (std::size_t y = 0; y < 3; ++y)
        for (std::size_t x = 0; x < 5; ++x)
            std::swap(swapped.bytes[y * source.view.stride + 4 * x],
                      swapped.bytes[y * source.view.stride + 4 * x + 2]);
    std::vector<std::uint8_t> red, blue;
    encodePng(source.view, red);
    encodePng(swapped.view, blue);
    EXPECT_EQ(red, blue);
}

TEST(ImageFiles, AGreyPngIsLoadedWithEqualChannels) {
    const TempFolder folder;
    const Padded source({4, 2}, PixelFormat::Gray8);
    savePng(folder / "g.png", source.view);
    const StoredImage read = loadImage(folder / "g.png");
    ASSERT_EQ(read.size, (Size{4, 2}));
    const std::uint8_t expected = source.view.data[source.view.stride + 3];
    const std::uint8_t* last = &read.pixels[(1 * 4 + 3) * 4];
    EXPECT_EQ(last[0], expected);
    EXPECT_EQ(last[1], expected);
    EXPECT_EQ(last[2], expected);
}

TEST(ImageFiles, BrokenPicturesAreRefusedWithTheFilesName) {
    const TempFolder folder;
    const fs::path file = folder / "a.png";
    const auto error = [&] { return errorOf([&] { static_cast<void>(loadImage(file)); }); };
    EXPECT_EQ(error(), file.string() + ": is missing");
    writeFile(file, "no picture at all");
    EXPECT_EQ(error(), file.string() + ": cannot be decoded: is neither PNG nor JPEG");
    savePng(file, test::plain({40, 30}, 9).view());
    fs::resize_file(file, fs::file_size(file) - 1);
    EXPECT_EQ(error(), file.string() + ": cannot be decoded: the file ends before the last pixel");
    savePng(file, test::plain({40, 30}, 9).view());
    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(60).put('x');
    EXPECT_NE(error(), "no error");
    writeFile(file, "\xff\xd8\xff\xe0 and nothing else");
    EXPECT_NE(error(), "no error");
}

TEST(ImageFiles, LoadingIntoABufferOfAnotherSizeIsRefused) {
    const TempFolder folder;
    savePng(folder / "a.png", test::plain({8, 8}, 9).view());
    std::uint8_t untouched = 77;
    EXPECT_EQ(errorOf([&] { loadImageInto(folder / "a.png", {8, 9}, &untouched, 32); }),
              (folder / "a.png").string() + ": is 8x8; expected 8x9");
    EXPECT_EQ(untouched, 77);
}

TEST(ImageFiles, AFailedSaveNamesTheFileAndLeavesNothing) {
    const TempFolder folder;
    const fs::path file = folder / "none/a.png";
    EXPECT_EQ(errorOf([&] { savePng(file, test::plain({8, 8}, 9).view()); }),
              file.string() + ": No such file or directory");
    savePng(folder / "b.png", test::plain({8, 8}, 9).view());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(FloatFiles, PfmRoundTripKeepsFiniteValuesAndMakesOthersNan) {
    const TempFolder folder;
    const FloatImage image{{3, 2}, {1, -2.5F, kNaN, 0, kInf, 1e-20F}};
    savePfm(folder / "a.pfm", image);
    const FloatImage read = loadPfm(folder / "a.pfm");
    ASSERT_EQ(read.size, image.size);
    EXPECT_EQ(read.at(0, 0), 1);
    EXPECT_EQ(read.at(1, 0), -2.5F);
    EXPECT_TRUE(std::isnan(read.at(2, 0)));
    EXPECT_TRUE(std::isnan(read.at(1, 1)));
    EXPECT_EQ(read.at(2, 1), 1e-20F);
}

TEST(FloatFiles, PfmBeginsWithTheBottomRowInEitherByteOrder) {
    const TempFolder folder;
    const std::string one("\x3f\x80\0\0", 4), two("\x40\0\0\0", 4);
    writeFile(folder / "big.pfm", "Pf\n1 2\n1.0\n" + one + two);
    EXPECT_EQ(loadPfm(folder / "big.pfm").values, (std::vector<float>{2, 1}));
    const std::string oneLittle("\0\0\x80\x3f", 4), twoLittle("\0\0\0\x40", 4);
    writeFile(folder / "little.pfm", "Pf\n1 2\n-1.0\n" + oneLittle + twoLittle);
    EXPECT_EQ(loadPfm(folder / "little.pfm").values, (std::vector<float>{2, 1}));
}

TEST(FloatFiles, BrokenPfmIsRefused) {
    const TempFolder folder;
    const fs::path file = folder / "a.pfm";
    const auto error = [&](const std::string& content) {
        writeFile(file, content);
        return errorOf([&] { static_cast<void>(loadPfm(file)); });
    };
    const std::string start = file.string() + ": ";
    EXPECT_EQ(error(""), start + "is not a PFM file");
    EXPECT_EQ(error("PF\n1 1\n-1\n............"),
              start + "is a colour PFM file; expected one channel");
    EXPECT_EQ(error("Pf\nx 1\n-1\n...."), start + "the PFM header is malformed");
    EXPECT_EQ(error("Pf\n1 1"), start + "the PFM header is malformed");
    EXPECT_EQ(error("Pf\n1 1\nnan\n...."),
              start + "the scale in the PFM header is 0 or not finite");
    EXPECT_EQ(error("Pf\n1 1\n-1\n..."), start + "has 3 bytes of pixel values; expected 4");
    EXPECT_EQ(error("Pf\n1 1\n-1\n....."), start + "has 5 bytes of pixel values; expected 4");
    EXPECT_EQ(error("Pf\n0 1\n-1\n"),
              start + "size 0x1 is invalid: width and height must be from 1 to 16384");
    EXPECT_EQ(error("Pf\n99999 99999\n-1\n...."),
              start + "size 99999x99999 is invalid: width and height must be from 1 to 16384");
}

TEST(FloatFiles, FloRoundTripKeepsFiniteVectorsAndMakesOthersNan) {
    const TempFolder folder;
    FlowImage flow{{2, 2}, {{{1, -2}}, {{kNaN, 0}}, {{0.125F, 3e8F}}, {{5, kInf}}}};
    saveFlo(folder / "a.flo", flow);
    const FlowImage read = loadFlo(folder / "a.flo");
    ASSERT_EQ(read.size, flow.size);
    EXPECT_EQ(read.at(0, 0), flow.at(0, 0));
    EXPECT_EQ(read.at(0, 1), flow.at(0, 1));
    for (const auto& unknown : {read.at(1, 0), read.at(1, 1)}) {
        EXPECT_TRUE(std::isnan(unknown[0]));
        EXPECT_TRUE(std::isnan(unknown[1]));
    }
}

TEST(FloatFiles, BrokenFloIsRefused) {
    const TempFolder folder;
    const fs::path file = folder / "a.flo";
    saveFlo(file, {{2, 2}, std::vector<std::array<float, 2>>(4)});
    const std::string good = test::readFile(file);
    const auto error = [&](const std::string& content) {
        writeFile(file, content);
        return errorOf([&] { static_cast<void>(loadFlo(file)); });
    };
    EXPECT_EQ(error(good), "no error");
    EXPECT_EQ(error(good.substr(0, 11)), file.string() + ": is not a .flo file");
    EXPECT_EQ(error("PIEX" + good.substr(4)), file.string() + ": is not a .flo file");
    EXPECT_EQ(error(good.substr(0, 43)),
              file.string() + ": has 31 bytes of pixel values; expected 32");
    EXPECT_EQ(error(good.substr(0, 4) + std::string(4, '\xff') + good.substr(8)),
              file.string() + ": size -1x2 is invalid: width and height must be from 1 to 16384");
}

TEST(SharedRecordings, MeasuredFlowOfTheSharedRecordingsIsRead) {
    const fs::path file = fs::path(MFAR_SHARED_DATA) / "rubberwhale/flow10.flo";
    if (!fs::exists(file)) GTEST_SKIP() << "measured flow is missing: " << file;
    const FlowImage flow = loadFlo(file);
    EXPECT_EQ(flow.size, (Size{584, 388}));
    for (const auto& v : flow.vectors)
        ASSERT_FALSE(std::abs(v[0]) > 100);
}

}  // namespace
}  // namespace mfar
