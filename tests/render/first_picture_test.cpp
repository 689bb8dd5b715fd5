// Two things make the first picture of a scene early: the renderer's threads allocate the memory
// before they trace, and may use more time.
#include "pipeline/slices/traced_renderer.h"
#include "tests/render/picture_driver.h"
#include "tests/render/still_life.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <thread>

namespace mfar {
namespace {

using namespace traced_pictures;

TEST(FirstPicture, MemoryIsProvidedOncePerScene) {
    const std::shared_ptr<FilmMemory> memory = Film::makeMemory();
    TracedPictures pictures(kThirtyTwo, kProduct, memory);
    EXPECT_FALSE(pictures.lacksMemory()) << "there is no scene";
    pictures.setScene(preparedStillLife(1, 1));
    EXPECT_FALSE(pictures.lacksMemory()) << "there is no view";
    const RenderView view = render_scenes::viewFrom({256, 192}, 20);
    pictures.look(view, view, {});
    ASSERT_TRUE(pictures.lacksMemory());
    RenderedPicture out;
    pictures.provide(out);
    EXPECT_FALSE(pictures.lacksMemory());
    EXPECT_EQ(out.light.size(), 256U * 192);
    const std::size_t provided = memory->ready();
    pictures.begin();
    while (!pictures.toShow()) {
        const TracedPictures::Portion portion = pictures.next(1000);
        pictures.trace(portion);
        pictures.done(portion, {}, 0);
    }
    const std::size_t used = provided - memory->ready();
    EXPECT_GT(used, 100U);
    EXPECT_LE(2 * used, provided) << "memory for the next picture must be provided too";
    pictures.setScene(preparedStillLife(2, 1));
    pictures.look(view, view, {});
    EXPECT_TRUE(pictures.lacksMemory());
}

TEST(FirstPicture, ObjectsOutOfViewNeedLittleMemory) {
    const std::shared_ptr<FilmMemory> memory = Film::makeMemory();
    TracedPictures pictures(kThirtyTwo, kProduct, memory);
    pictures.setScene(preparedStillLife(1, 1));
    RenderView away = render_scenes::viewFrom({256, 192}, 20);
    away.T_world_camera.translation *= -1;  // everything is behind the camera
    pictures.look(away, away, {});
    ASSERT_TRUE(pictures.lacksMemory());
    RenderedPicture out;
    pictures.provide(out);
    EXPECT_FALSE(pictures.lacksMemory());
    EXPECT_LT(memory->ready(), 1U);
}

// If threads have provided the memory before the first picture is traced, at least half of it is
// unused after this picture. If not, the film allocates only a few blocks at a time, so that almost
// no memory is unused.
TEST(FirstPicture, ThreadsOfTheRendererProvideItsMemory) {
    const std::shared_ptr<FilmMemory> expected = Film::makeMemory(), piece = Film::makeMemory();
    TracedPictures pictures(kThirtyTwo, kProduct, expected);
    pictures.setScene(preparedStillLife(1, 1));
    const RenderView view = render_scenes::viewFrom({256, 192}, 20);
    pictures.look(view, view, {});
    RenderedPicture out;
    pictures.provide(out);
    static_cast<void>(piece->take());
    ASSERT_LT(piece->ready(), expected->ready() / 4);

    const std::shared_ptr<FilmMemory> memory = Film::makeMemory();
    TracedRendererOptions options;
    options.slices = kThirtyTwo;
    options.policy = kProduct;
    TracedRenderer renderer(options, memory);
    renderer.setScene(render_scenes::stillLife());
    for (int frame = 1; renderer.counters().shown == 0; ++frame) {
        renderer.update(view, Timestamp::fromSeconds(1 + frame / 30.0));
        while (!renderer.rests())
            std::this_thread::yield();
    }
    EXPECT_GE(memory->ready(), expected->ready() / 2);
}

// Each frame waits until the threads have used up their time.
TEST(FirstPicture, BeforeTheFirstPictureTheThreadsMayUseTwiceTheirTimeBudget) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "with the thread sanitizer, one step takes longer than the budget";
#endif
    TracedRendererOptions options;
    options.slices = {Slicing::Time, 16, 2, 0, 4};
    options.budgetMs = 0.25;
    TracedRenderer renderer(options);
    renderer.setScene(render_scenes::stillLife());
    const RenderView view = render_scenes::viewFrom({160, 120}, 20);
    int frames = 0;
    const auto msPerFrame = [&](const std::function<bool()>& reached) {
        const int first = frames;
        double cpuMs = 0;
        while (!reached()) {
            renderer.update(view, Timestamp::fromSeconds(1 + ++frames / 30.0));
            while (!renderer.rests())
                std::this_thread::yield();
            if (frames == first + 1) cpuMs = renderer.counters().cpuMs;
        }
        EXPECT_GT(frames, first + 5);
        return (renderer.counters().cpuMs - cpuMs) / (frames - first - 1);
    };
    const double before = msPerFrame([&] { return renderer.counters().shown > 0; });
    EXPECT_NEAR(before / options.budgetMs, 2, 0.5);
    const int shownAt = frames;
    const double after = msPerFrame([&] { return frames == shownAt + 30; });
    EXPECT_NEAR(after / options.budgetMs, 1, 0.4);
}

}  // namespace
}  // namespace mfar
