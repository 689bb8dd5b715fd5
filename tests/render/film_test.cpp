#include "pipeline/render/film.h"
#include "pipeline/render/picture_resolver.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace mfar {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

FilmSample objectSample(float radiance, float depth = 1, std::uint8_t id = 1) {
    const Eigen::Vector3f grey = Eigen::Vector3f::Constant(radiance);
    FilmSample out{{depth, id}, grey, {0, 0, 0}};
    out.light.diffuse = grey;
    out.paint.diffuse = {1, 1, 1};
    return out;
}

FilmSample catcherSample(const Eigen::Vector3f& with, const Eigen::Vector3f& without) {
    return {{2, kCatcherId}, with, without};
}

RenderedPicture pictureOf(const Film& film, const Exposure& exposure = {}) {
    RenderView view;
    view.camera.size = film.size();
    RenderedPicture out;
    resolve(film, view, exposure, out);
    return out;
}

using Rgba = std::array<std::uint8_t, 4>;

TEST(Film, EmptyFilmGivesTransparentPixels) {
    const Film film({3, 2});
    const RenderedPicture picture = pictureOf(film);
    ASSERT_EQ(picture.colour.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(picture.colour[i], Rgba{});
        EXPECT_EQ(picture.depth[i], 0);
        EXPECT_EQ(picture.id[i], 0);
        EXPECT_TRUE(std::isinf(film.error(i)));
    }
    EXPECT_EQ(picture.samples, 0);
}

TEST(Film, ObjectPixelIsThePremultipliedMeanOfItsSamples) {
    Film film({1, 1});
    film.add(0, objectSample(0.1F, 1.5F, 7));
    film.add(0, objectSample(0.3F, 1.2F, 7));
    film.add(0, {});
    film.add(0, {});
    const RenderedPicture picture = pictureOf(film);
    const int expected = static_cast<int>(std::lround(255 * 0.5F * srgbEncoded(0.2F)));
    EXPECT_EQ(picture.colour[0][0], expected);
    EXPECT_EQ(picture.colour[0][3], 128);
    EXPECT_EQ(picture.id[0], 7);
    // The nearest sample gives the depth, because the ray through the centre hits nothing.
    EXPECT_EQ(picture.depth[0], 1.2F);
    EXPECT_EQ(picture.samples, 4);
}

TEST(Film, MeanAndErrorOfAMillionSamplesAreExact) {
    Film film({2, 1});
    double sum = 0, squares = 0;
    constexpr int kSamples = 1000000;
    for (int i = 0; i < kSamples; ++i) {
        const float value = 0.1F + 1e-4F * static_cast<float>(i % 3 - 1);
        film.add(0, objectSample(value));
        film.add(1, catcherSample(Eigen::Vector3f::Constant(value), Eigen::Vector3f::Ones()));
        sum += value;
        squares += double(value) * value;
    }
    const double mean = sum / kSamples;
    EXPECT_NEAR(film.means(0).object.x(), mean, 1e-8);
    EXPECT_NEAR(film.means(1).with.x(), mean, 1e-8);
    const double deviation = std::sqrt((squares - sum * mean) / kSamples / (kSamples - 1));
    const double slope = 255 * srgbSlope(static_cast<float>(mean));
    EXPECT_NEAR(film.error(0) / (slope * deviation), 1, 1e-3);
}

TEST(Film, DepthBelongsToThePixelsCentre) {
    Film film({1, 1});
    film.setCentre(0, {{1.5F, 2}});
    film.add(0, objectSample(0.1F, 1.0F, 1));
    const RenderedPicture picture = pictureOf(film);
    EXPECT_EQ(picture.depth[0], 1.5F);
    EXPECT_EQ(picture.id[0], 2);
}

TEST(Film, AShadowIsBlackAndItsAlphaFollowsFromTheLightRatio) {
    Film film({1, 1});
    film.setCentre(0, {{2, kCatcherId}});
    film.add(0, catcherSample({0.1F, 0.05F, 0.025F}, {0.4F, 0.2F, 0.1F}));
    const RenderedPicture picture = pictureOf(film);
    const int coverage = static_cast<int>(std::lround(255 * (1 - std::pow(0.25F, 1 / 2.2F))));
    EXPECT_EQ(picture.colour[0], (Rgba{0, 0, 0, static_cast<std::uint8_t>(coverage)}));
    EXPECT_EQ(picture.id[0], kCatcherId);
    EXPECT_EQ(picture.depth[0], 2);
}

TEST(Film, BouncedLightAddsColour) {
    Film film({1, 1});
    film.add(0, catcherSample({0.3F, 0.2F, 0.2F}, {0.2F, 0.2F, 0.2F}));
    const RenderedPicture picture = pictureOf(film);
    EXPECT_GT(picture.colour[0][0], 20);
    EXPECT_EQ(picture.colour[0][1], 0);
    EXPECT_EQ(picture.colour[0][3], 0);
    EXPECT_EQ(picture.id[0], kCatcherId);
}

TEST(Film, BouncedLightOnADarkSurfaceIsVisible) {
    Film film({1, 1});
    film.add(0, catcherSample({0.3F, 0, 0}, {0, 0, 0}));
    EXPECT_EQ(pictureOf(film).colour[0],
              (Rgba{static_cast<std::uint8_t>(std::lround(255 * srgbEncoded(0.3F))), 0, 0, 0}));
}

TEST(Film, UnchangedShadowCatcherIsTransparent) {
    Film film({1, 1});
    film.setCentre(0, {{2, kCatcherId}});
    film.add(0, catcherSample({0.37F, 0.2F, 0.11F}, {0.37F, 0.2F, 0.11F}));
    const RenderedPicture picture = pictureOf(film);
    EXPECT_EQ(picture.colour[0], Rgba{});
    EXPECT_EQ(picture.id[0], 0);
    EXPECT_EQ(picture.depth[0], 0);
}

TEST(Film, NonFiniteSamplesAreDroppedAndCounted) {
    Film film({1, 1});
    film.add(0, objectSample(0.2F));
    film.add(0, objectSample(kNan));
    film.add(0, objectSample(std::numeric_limits<float>::infinity()));
    film.add(0, objectSample(-1));
    film.add(0, catcherSample({1, 1, 1}, {kNan, 1, 1}));
    FilmSample bright = objectSample(0.2F);
    bright.light.specular.x() = std::numeric_limits<float>::infinity();
    film.add(0, bright);
    EXPECT_EQ(film.dropped(), 5U);
    EXPECT_EQ(film.samples(0), 6U);
    const RenderedPicture picture = pictureOf(film);
    EXPECT_EQ(picture.colour[0][0], std::lround(255 * srgbEncoded(0.2F)));
    EXPECT_EQ(picture.colour[0][3], 255);
}

// The object at the pixel's centre was hit by no sample, so its light is unknown.
TEST(Film, ObjectWithUnknownLightIsShownInItsFarLight) {
    SeenSurface seen{{1, 3}};
    seen.paint.diffuse = {0.5F, 0.5F, 0.5F};
    seen.far.diffuse = {0.4F, 0.4F, 0.4F};
    Film film({1, 1});
    film.setCentre(0, seen);
    film.add(0, catcherSample({0.1F, 0.1F, 0.1F}, {0.2F, 0.2F, 0.2F}));
    EXPECT_EQ(film.resolved(0, {}).hit.id, 3);
    EXPECT_NEAR(unpackedWords(film.resolved(0, {}).light).diffuse[0], 0.4F, 0.01F);
    film.clear(0);
    film.setCentre(0, seen);
    const LightPixel unknown{.depth = 1, .id = 3};
    EXPECT_NEAR(unpackedWords(film.resolvedFrom(unknown, 0, {}).light).diffuse[0], 0.4F, 0.01F);
    EXPECT_NEAR(film.resolvedFrom(unknown, 0, {}).colour[0], 255 * srgbEncoded(0.2F), 1);
}

TEST(Film, EdgePixelStoresTheLightOfTheSurfaceAtItsCentre) {
    const FilmSample shadow = catcherSample({0.1F, 0.1F, 0.1F}, {0.4F, 0.4F, 0.4F});
    for (const std::uint8_t centre : {std::uint8_t{1}, std::uint8_t{2}, kCatcherId}) {
        Film film({1, 1});
        film.setCentre(0, {{1, centre}});
        for (const FilmSample& sample :
             {objectSample(0.2F, 1, 1), objectSample(0.8F, 1, 2), shadow})
            for (int i = 0; i < 4; ++i)
                film.add(0, sample);
        const float expected = centre == 1 ? 0.2F : centre == 2 ? 0.8F : -0.3F;
        EXPECT_NEAR(film.known(0).first[0], expected, 1e-4F) << int{centre};
        EXPECT_EQ(film.known(0).firstCount, 4) << int{centre};
        const LightPixel light = film.light(0, {});
        EXPECT_EQ(light.id, centre);
        EXPECT_NEAR(light.first[0], expected, 1e-4F) << int{centre};
        // means() mixes the light of both objects.
        EXPECT_NEAR(film.means(0).object[0], 0.5F, 1e-4F);
        EXPECT_NEAR(film.means(0).objectShare, 2.0F / 3, 1e-4F);
    }
}

TEST(Film, LayeredPictureDoesNotMixSurfacesAtEdges) {
    SeenSurface seen{{1, 1}};
    seen.paint.diffuse = {1, 1, 1};
    Film film({1, 1});
    film.setCentre(0, seen);
    film.add(0, objectSample(0.5F));
    film.add(0, {});
    const LightPixel light = film.light(0, {});
    const Film::Resolved mixed = film.resolvedFrom(light, 0, {});
    const Film::Resolved layered = film.resolvedFrom(light, 0, {}, true);
    EXPECT_EQ(mixed.colour[3], 128);
    EXPECT_EQ(layered.colour[3], 255);
    EXPECT_NEAR(layered.colour[0], 255 * srgbEncoded(0.5F), 1);
    EXPECT_EQ(mixed.light, layered.light);
}

TEST(Film, AFilteredShadowThatTakesMoreThanAllLightIsBlack) {
    Film film({1, 1});
    film.setCentre(0, {{2, kCatcherId}});
    film.add(0, catcherSample({0.1F, 0.1F, 0.1F}, {0.5F, 0.5F, 0.5F}));
    LightPixel light = film.light(0, {});
    ASSERT_EQ(light.id, kCatcherId);
    // Both parts are filtered separately, so the shadow may take more light than there is.
    light.first.setConstant(-0.6F);
    light.second.setConstant(0.5F);
    const Film::Resolved shadow = film.resolvedFrom(light, 0, {});
    EXPECT_EQ(shadow.colour, (Rgba{0, 0, 0, 255}));
    EXPECT_EQ(shadow.hit.id, kCatcherId);
}

TEST(Film, ALayeredShadowFromNeighboursStaysOnTheCatcher) {
    Film film({1, 1});
    film.setCentre(0, {{2, kCatcherId}});
    film.add(0, objectSample(0.5F));  // at the edge of an object
    LightPixel light = film.light(0, {});
    light.id = kCatcherId;
    light.first.setConstant(-0.3F);
    light.second.setConstant(0.5F);
    const Film::Resolved layered = film.resolvedFrom(light, 0, {}, true);
    EXPECT_GT(layered.colour[3], 0);
    EXPECT_EQ(layered.hit.id, kCatcherId);
    EXPECT_EQ(layered.hit.depth, 2);
}

TEST(Film, EachPixelKeepsItsOwnValue) {
    Film film({19, 11});  // not a multiple of the tile size
    const auto count = static_cast<std::uint32_t>(19 * 11);
    for (std::uint32_t i = 0; i < count; ++i)
        film.setCentre(i, {{static_cast<float>(i + 1), 1}});
    for (std::uint32_t i = 0; i < count; ++i)
        ASSERT_EQ(film.centre(i).hit.depth, static_cast<float>(i + 1));
    const Film moved = std::move(film);
    EXPECT_EQ(moved.centre(count - 1).hit.depth, static_cast<float>(count));
}

/// Address space of this process [bytes].
std::size_t addressSpace() {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(Film, UnusedBlocksOfPixelsReserveNoMemory) {
    const std::size_t before = addressSpace();
    Film film({4096, 4096});
    for (std::uint32_t i = 0; i < 4096; ++i)
        film.setCentre(i * 4096 + i, {{1, 1}});
    // Memory for all pixels would be 8 GB.
    EXPECT_LT(addressSpace() - before, std::size_t{64} << 20);
}

TEST(Film, NextPictureReusesTheMemoryOfThePreviousPicture) {
    const std::shared_ptr<FilmMemory> memory = Film::makeMemory();
    Film film({256, 256}, memory);
    for (std::uint32_t i = 0; i < 65536; ++i)
        film.setCentre(i, {{1, 1}});
    const std::size_t all = memory->ready() + 65536 / Film::kBlockPixels;
    film.begin();
    EXPECT_EQ(memory->ready(), all);
    EXPECT_FALSE(film.isSeen(5));
    for (std::uint32_t i = 0; i < 65536; ++i)
        film.setCentre(i, {{2, 1}});
    EXPECT_EQ(memory->ready(), all - 65536 / Film::kBlockPixels);
    {
        const Film moved = std::move(film);
    }
    EXPECT_EQ(memory->ready(), all) << "a film's destructor must return its blocks";
}

TEST(Film, PixelsOfProvidedMemoryCauseFewPageFaults) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the thread sanitizer's shadow memory causes page faults";
#endif
    const auto faults = [] {
        rusage usage{};
        getrusage(RUSAGE_THREAD, &usage);
        return usage.ru_minflt;
    };
    constexpr std::uint32_t kPixels = 256 * 256;
    const std::shared_ptr<FilmMemory> memory = Film::makeMemory();
    memory->provide(kPixels / Film::kBlockPixels);
    Film film({256, 256}, memory);
    film.setCentre(0, {{1, 1}});
    const long before = faults();
    for (std::uint32_t i = 0; i < kPixels; ++i)
        film.setCentre(i, {{1, 1}});
    EXPECT_LE(faults() - before, 20) << "32 MB are 8000 small pages or 16 large ones";
}

TEST(Film, SeveralThreadsCanWritePixelsOfOneBlockAtTheSameTime) {
    for (int round = 0; round < 20; ++round) {
        Film film({64, 64});
        std::vector<std::jthread> threads;
        for (std::uint32_t first = 0; first < 4; ++first)
            threads.emplace_back([&film, first] {
                for (std::uint32_t i = first; i < 64 * 64; i += 4)
                    film.setCentre(i, {{static_cast<float>(i + 1), 1}});
            });
        threads.clear();
        for (std::uint32_t i = 0; i < 64 * 64; ++i)
            ASSERT_EQ(film.centre(i).hit.depth, static_cast<float>(i + 1));
    }
}

TEST(Film, ErrorIsTheStandardErrorOfTheDisplayedGreyLevel) {
    Film film({1, 1});
    film.add(0, objectSample(0.4F));
    EXPECT_TRUE(std::isinf(film.error(0)));
    for (int i = 1; i < 64; ++i)
        film.add(0, objectSample(i % 2 == 0 ? 0.4F : 0.6F));
    // The error is 0.1 / sqrt(64), times the slope of the sRGB encoding at 0.5.
    const float slope = (srgbEncoded(0.501F) - srgbEncoded(0.499F)) / 0.002F;
    EXPECT_NEAR(film.error(0), 255 * slope * 0.1F / 8, 0.05F);
    // Half the light at twice the exposure gives the same picture.
    Film dim({1, 1});
    for (int i = 0; i < 64; ++i)
        dim.add(0, objectSample(i % 2 == 0 ? 0.2F : 0.3F));
    EXPECT_NEAR(dim.error(0, {2}), film.error(0), 0.01F);
}

TEST(Film, UniformLightHasZeroError) {
    Film film({2, 1});
    for (int i = 0; i < 4; ++i) {
        film.add(0, {});
        film.add(1, catcherSample({0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}));
    }
    EXPECT_EQ(film.error(0), 0);
    EXPECT_EQ(film.error(1), 0);
}

TEST(Film, ErrorOfAnEdgePixelFallsWithItsSamples) {
    const auto edge = [](int samples) {
        Film film({1, 1});
        for (int i = 0; i < samples; ++i)
            film.add(0, i % 2 == 0 ? objectSample(0.5F) : FilmSample{});
        return film.error(0);
    };
    EXPECT_NEAR(edge(16) / edge(256), 8, 0.1);
}

TEST(Film, ClearDiscardsAllSamples) {
    Film film({2, 1});
    film.setCentre(0, {{1, 1}});
    film.add(0, objectSample(0.5F));
    film.add(1, objectSample(0.5F));
    film.clear(0);
    EXPECT_EQ(film.samples(0), 0U);
    EXPECT_EQ(film.samples(1), 1U);
    EXPECT_EQ(pictureOf(film).id[0], 0);
    film.add(0, objectSample(0.5F));
    film.begin();
    EXPECT_EQ(film.samples(0), 0U);
    EXPECT_EQ(film.samples(1), 0U);
    EXPECT_EQ(pictureOf(film).id[1], 0);
    EXPECT_EQ(film.dropped(), 0U);
    film.add(1, objectSample(kNan));
    EXPECT_EQ(film.samples(1), 1U);
    EXPECT_EQ(film.dropped(), 1U);
}

TEST(Exposure, SrgbFollowsTheStandard) {
    EXPECT_NEAR(srgbEncoded(0.214041F), 0.5F, 1e-4F);
    EXPECT_EQ(srgbEncoded(-1), 0);
    EXPECT_EQ(srgbEncoded(kNan), 0);
    EXPECT_EQ(srgbEncoded(7), 1);
    for (const float x : {0.0F, 0.002F, 0.04F, 0.3F, 0.99F})
        EXPECT_NEAR(srgbDecoded(srgbEncoded(x)), x, 1e-5F);
    EXPECT_NEAR(srgbSlope(0.3F), (srgbEncoded(0.301F) - srgbEncoded(0.299F)) / 0.002F, 1e-3F);
}

}  // namespace
}  // namespace mfar
