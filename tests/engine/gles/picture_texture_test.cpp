#include "pipeline/gles/picture_texture.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"
#include "tests/oracle/yuv.h"
#include "tests/unit/padded_picture.h"

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar {
namespace {

using test::kEveryFormat;
using test::PaddedPicture;
using PictureTexture = GlTest;

constexpr Size kEvenSize{54, 38};

// Tolerance: rounding to 8 bits.
double converted() {
    return 0.501 * roundingFactor();
}

// Tolerance: a bilinear filter with weights of 8 bits errs by up to one grey level in each chroma
// channel. The conversion to RGB multiplies this error by up to 2.12.
double chromaConverted() {
    return converted() + 2.2;
}

void expectTwin(const gpu::PictureTexture& picture, const ImageView& view, double tolerance) {
    const auto pixels = sampled(picture.texture());
    ASSERT_EQ(picture.texture().size(), view.size);
    double worst = 0;
    for (int y = 0; y < view.size.height; ++y)
        for (int x = 0; x < view.size.width; ++x) {
            const auto rgb = twin::rgbAt(view, x, y);
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * view.size.width + x);
            for (std::size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(pixels[i + c] - rgb[c]));
        }
    EXPECT_LE(worst, tolerance) << nameOf(view.format);
}

bool isYuv(PixelFormat format) {
    return format == PixelFormat::Yuyv || format == PixelFormat::Nv12 ||
           format == PixelFormat::Yuv420;
}

TEST_F(PictureTexture, EveryFormatWithPaddedRowsMatchesTheOracle) {
    for (const PixelFormat format : kEveryFormat) {
        const PaddedPicture source(format, kEvenSize, 3);
        for (const YuvMatrix matrix : {YuvMatrix::Bt601, YuvMatrix::Bt709})
            for (const YuvRange range : {YuvRange::Limited, YuvRange::Full}) {
                gpu::PictureTexture picture;
                const ImageView view = source.view(matrix, range);
                picture.upload(view);
                expectTwin(picture, view, isYuv(format) ? chromaConverted() : 0);
            }
    }
}

TEST_F(PictureTexture, RowsMayHaveAnyNumberOfBytes) {
    for (const PixelFormat format : kEveryFormat) {
        const PaddedPicture source(format, kEvenSize, 3, 5);
        gpu::PictureTexture picture;
        picture.upload(source.view());
        expectTwin(picture, source.view(), isYuv(format) ? chromaConverted() : 0);
    }
}

// Constant chroma needs no filter. So the test needs no tolerance for chroma, which could hide an
// error of luma.
TEST_F(PictureTexture, LumaIsExact) {
    for (const PixelFormat format : {PixelFormat::Yuyv, PixelFormat::Nv12, PixelFormat::Yuv420}) {
        PaddedPicture source(format, kEvenSize, 4);
        if (format == PixelFormat::Yuyv)
            for (std::size_t i = 1; i < source.plane(0).size(); i += 2)
                source.plane(0)[i] = 140;
        else
            for (int i = 1; i < planeCount(format); ++i)
                std::fill(source.plane(i).begin(), source.plane(i).end(), std::uint8_t{140});
        gpu::PictureTexture picture;
        picture.upload(source.view());
        expectTwin(picture, source.view(), converted());
    }
}

TEST_F(PictureTexture, FormatAndSizeMayChangeFromPictureToPicture) {
    gpu::PictureTexture picture;
    for (const Size size : {kEvenSize, Size{26, 50}})
        for (const PixelFormat format : {PixelFormat::Nv12, PixelFormat::Bgra8, PixelFormat::Gray8,
                                         PixelFormat::Yuyv, PixelFormat::Rgba8}) {
            const PaddedPicture source(format, size, 5);
            picture.upload(source.view());
            expectTwin(picture, source.view(), isYuv(format) ? chromaConverted() : 0);
        }
}

TEST_F(PictureTexture, AnUploadReplacesTheWholePicture) {
    gpu::PictureTexture picture;
    GLuint id = 0;
    for (unsigned seed = 1; seed < 4; ++seed) {
        const PaddedPicture source(PixelFormat::Yuv420, kEvenSize, seed);
        picture.upload(source.view());
        expectTwin(picture, source.view(), chromaConverted());
        EXPECT_TRUE(id == 0 || id == picture.texture().id())
            << "the texture must not be allocated again";
        id = picture.texture().id();
    }
}

/// Acts like a driver that imports memory, but copies the memory.
class FakeImporter final : public PlaneImporter {
public:
    unsigned import(const SharedPlane& plane) override {
        ++imports;
        if (refuses) throw std::runtime_error("not this memory");
        GLuint texture = 0;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        constexpr std::array<GLenum, 5> kFormats{0, GL_RED, GL_RG, 0, GL_RGBA};
        constexpr std::array<GLint, 5> kStored{0, GL_R8, GL_RG8, 0, GL_RGBA8};
        const auto channels = static_cast<std::size_t>(plane.channels);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(plane.stride / channels));
        glTexImage2D(GL_TEXTURE_2D, 0, kStored[channels], plane.size.width, plane.size.height, 0,
                     kFormats[channels], GL_UNSIGNED_BYTE,
                     memory.at(static_cast<std::size_t>(plane.fd)) + plane.offset);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        alive.insert(texture);
        return texture;
    }
    void forget(unsigned texture) override {
        glDeleteTextures(1, &texture);
        EXPECT_EQ(alive.erase(texture), 1U);
    }

    std::vector<const std::uint8_t*> memory;  ///< index: file descriptor
    std::set<unsigned> alive;
    int imports = 0;
    bool refuses = false;
};

/// A picture whose planes are only in the importer's memory. The memory that the CPU can read
/// contains another picture.
struct SharedPicture {
    SharedPicture(PixelFormat format, FakeImporter& importer, std::uint64_t id)
        : real(format, kEvenSize, 4), other(format, kEvenSize, 4), view(real.view()),
          shown(other.view()) {
        for (int i = 0; i < planeCount(format); ++i)
            std::fill(other.plane(i).begin(), other.plane(i).end(), std::uint8_t{0});
        memory.id = id;
        for (std::size_t i = 0; i < static_cast<std::size_t>(planeCount(format)); ++i) {
            const std::uint8_t* begin = i == 0 ? view.data : view.chroma[i - 1].data;
            // A plane may begin anywhere in its buffer.
            memory.planes[i] = {static_cast<int>(importer.memory.size()), 4 * i};
            importer.memory.push_back(begin - 4 * i);
        }
        shown.shared = &memory;
    }
    PaddedPicture real, other;
    ImageView view, shown;
    SharedMemory memory;
};

TEST_F(PictureTexture, SharedMemoryIsReadWithoutACopy) {
    for (const PixelFormat format : {PixelFormat::Yuyv, PixelFormat::Nv12, PixelFormat::Yuv420}) {
        FakeImporter importer;
        {
            gpu::PictureTexture picture;
            picture.setImporter(&importer);
            const SharedPicture source(format, importer, 1);
            for (int i = 0; i < 3; ++i) {
                picture.upload(source.shown);
                expectTwin(picture, source.view, chromaConverted());
            }
            EXPECT_EQ(importer.imports, planeCount(format)) << "each buffer must be imported once";
            picture.finishReading();
            EXPECT_EQ(picture.takeImportFault(), std::nullopt);
        }
        EXPECT_TRUE(importer.alive.empty());
    }
}

TEST_F(PictureTexture, OnlyTheNewestBuffersStayImported) {
    FakeImporter importer;
    gpu::PictureTexture picture;
    picture.setImporter(&importer);
    std::vector<std::unique_ptr<SharedPicture>> sources;
    for (std::uint64_t id = 1; id <= 40; ++id) {
        sources.push_back(std::make_unique<SharedPicture>(PixelFormat::Nv12, importer, id));
        picture.upload(sources.back()->shown);
        EXPECT_LE(importer.alive.size(), 32U);
    }
    const int before = importer.imports;
    picture.upload(sources.back()->shown);
    EXPECT_EQ(importer.imports, before);
    expectTwin(picture, sources.back()->view, chromaConverted());
    picture.setImporter(nullptr);
    EXPECT_TRUE(importer.alive.empty());
}

TEST_F(PictureTexture, MemoryThatTheDriverRefusesIsCopied) {
    FakeImporter importer;
    importer.refuses = true;
    gpu::PictureTexture picture;
    picture.setImporter(&importer);
    const SharedPicture source(PixelFormat::Nv12, importer, 1);
    for (int i = 0; i < 2; ++i) {
        picture.upload(source.shown);
        expectTwin(picture, source.other.view(), chromaConverted());
    }
    EXPECT_EQ(importer.imports, 1);
    EXPECT_EQ(picture.takeImportFault(), "not this memory");
    EXPECT_EQ(picture.takeImportFault(), std::nullopt);
}

TEST_F(PictureTexture, APictureLargerThanTheGpuAllowsIsReported) {
    try {
        const gpu::Texture texture({1 << 20, 8}, gpu::TexelFormat::Rgba8);
        FAIL() << "a texture wider than any GPU allows was accepted";
    } catch (const gpu::GlError& e) {
        EXPECT_NE(std::string(e.what()).find("1048576x8 pixels exceeds this GPU's limit"),
                  std::string::npos)
            << e.what();
    }
}

}  // namespace
}  // namespace mfar
