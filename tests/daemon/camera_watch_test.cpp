#include "daemon/camera_watch.h"

#include <cstdint>
#include <gmock/gmock.h>
#include <vector>

namespace mfar {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Size kSize{40, 64};

/// A camera whose pictures the test sends, on a simulated clock.
struct Watched {
    explicit Watched(CameraKind kind, double rateHz = 30)
        : watch({"video camera", kSize, PixelFormat::Gray8, rateHz}, kind),
          pixels(static_cast<std::size_t>(kSize.width) * kSize.height, 100) {}

    void send(std::chrono::nanoseconds after, bool noise = true) {
        now = now + after;
        if (noise) ++pixels[(++noises * 37) % pixels.size()], ++pixels[2 * kSize.width];
        watch.add(
            Frame({pixels.data(), kSize, static_cast<std::size_t>(kSize.width), PixelFormat::Gray8},
                  now, nullptr),
            now);
        watch.add(counters);
    }

    CameraWatch watch;
    std::vector<std::uint8_t> pixels;
    CameraCounters counters{};
    Timestamp now = Timestamp::fromSeconds(100);
    std::size_t noises = 0;
};

TEST(CameraWatch, AWrongRateIsReportedOnceAndOnlyAfterAWhile) {
    Watched camera(CameraKind::Sensor);
    for (int i = 0; i < 20; ++i)
        camera.send(66'666'667ns);
    EXPECT_NEAR(camera.watch.state().rateHz, 15, 0.01);
    EXPECT_THAT(camera.watch.takeWarnings(), IsEmpty())
        << "a short measurement must not give a warning";
    for (int i = 0; i < 100; ++i)
        camera.send(66'666'667ns);
    EXPECT_THAT(
        camera.watch.takeWarnings(),
        ElementsAre("video camera: sends 15.0 frames per second instead of the configured 30"));
    for (int i = 0; i < 100; ++i)
        camera.send(66'666'667ns);
    EXPECT_THAT(camera.watch.takeWarnings(), IsEmpty());
    EXPECT_EQ(camera.watch.state().counters.missed, 0U);
}

TEST(CameraWatch, ANearlyRightRateIsNotReported) {
    for (const double hz : {28., 30., 32.}) {
        Watched camera(CameraKind::Sensor);
        for (int i = 0; i < 300; ++i)
            camera.send(std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / hz)));
        EXPECT_THAT(camera.watch.takeWarnings(), IsEmpty()) << hz;
    }
}

TEST(CameraWatch, AFrozenPictureIsReportedOnceEachTime) {
    Watched camera(CameraKind::Sensor);
    for (int round = 1; round <= 2; ++round) {
        for (int i = 0; i < 30; ++i)
            camera.send(33'333'333ns);
        const Timestamp last = camera.now;
        EXPECT_EQ(camera.watch.state().lastDistinct, last);
        for (int i = 0; i < 59; ++i)
            camera.send(33'333'333ns, false);
        EXPECT_THAT(camera.watch.takeWarnings(), IsEmpty()) << "no warning before two seconds";
        for (int i = 0; i < 90; ++i)
            camera.send(33'333'333ns, false);
        EXPECT_THAT(camera.watch.takeWarnings(), ElementsAre(HasSubstr("the same picture")));
        EXPECT_EQ(camera.watch.state().lastDistinct, last);
        EXPECT_EQ(camera.watch.state().repeated, 149U * static_cast<unsigned>(round));
    }
}

TEST(CameraWatch, RecordingsAndSyntheticCamerasMayRepeatPicturesAndHaveAnyRate) {
    for (const CameraKind kind : {CameraKind::Stored, CameraKind::Live}) {
        Watched camera(kind);
        for (int i = 0; i < 300; ++i)
            camera.send(66'666'667ns, false);
        EXPECT_THAT(camera.watch.takeWarnings(), IsEmpty());
        EXPECT_EQ(camera.watch.state().repeated, 0U);
        EXPECT_FALSE(camera.watch.state().lastDistinct);
    }
}

TEST(CameraWatch, MissedFramesAreCountedByTheCameraOrElseFromFrameTimes) {
    Watched camera(CameraKind::Live);
    for (int i = 0; i < 40; ++i)
        camera.send(33'333'333ns);
    camera.send(4 * 33'333'333ns);
    EXPECT_EQ(camera.watch.state().counters.missed, 3U);
    EXPECT_EQ(camera.watch.state().counters.delivered, 41U);
    camera.counters.missed = 17;
    camera.counters.delivered = 9;
    camera.send(33'333'333ns);
    EXPECT_EQ(camera.watch.state().counters.missed, 17U);
    EXPECT_EQ(camera.watch.state().counters.delivered, 9U);
    Watched stored(CameraKind::Stored);
    for (int i = 0; i < 40; ++i)
        stored.send(33'333'333ns * (1 + i % 3));
    EXPECT_EQ(stored.watch.state().counters.missed, std::nullopt);
}

TEST(CameraWatch, ChecksumsDependOnEveryByteOfTheRowsThatTheyCover) {
    std::vector<std::uint8_t> pixels(40 * 64, 7);
    const ImageView view{pixels.data(), {37, 64}, 40, PixelFormat::Gray8};
    const std::uint64_t before = sparseChecksum(view);
    EXPECT_EQ(sparseChecksum(view), before);
    for (std::size_t x = 0; x < 37; ++x) {
        pixels[2 * 40 + x] ^= 1;  // row 2 is the first covered row
        EXPECT_NE(sparseChecksum(view), before) << x;
        pixels[2 * 40 + x] ^= 1;
    }
    pixels[2 * 40 + 37] ^= 1;
    EXPECT_EQ(sparseChecksum(view), before) << "bytes of the padding must not change the checksum";
}

}  // namespace
}  // namespace mfar
