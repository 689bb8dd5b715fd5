#include "pipeline/render/picture_resolver.h"
#include "pipeline/slices/traced_renderer.h"
#include "tests/render/still_life.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace mfar {
namespace {

using std::chrono::steady_clock;

constexpr Size kRenderSize{48, 36};

TracedRendererOptions quick() {
    TracedRendererOptions out;
    out.slices = {Slicing::Time, 16, 2, 0, 4};
    out.policy = {{4, 0.2}, 4};
    out.budgetMs = 1000;
    return out;
}

/// Runs frames without other work. Their time stamps are 1/30 s apart.
class Frames {
public:
    explicit Frames(const TracedRendererOptions& options) : renderer(options) {}

    void frame(const RenderView& view) {
        ++count_;
        renderer.update(view, now());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    [[nodiscard]] Timestamp now() const { return Timestamp::fromSeconds(1 + count_ / 30.0); }
    /// Waits until the threads have received the frame.
    bool seen() {
        const auto end = steady_clock::now() + std::chrono::seconds(60);
        while (renderer.counters().frame < now()) {
            if (steady_clock::now() > end) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }
    /// Runs frames until `reached` returns true. Returns false if it never does.
    bool until(const RenderView& view, const std::function<bool()>& reached) {
        const auto end = steady_clock::now() + std::chrono::seconds(60);
        while (!reached()) {
            if (steady_clock::now() > end) return false;
            frame(view);
        }
        return true;
    }
    bool finish(const RenderView& view, std::uint64_t pictures = 1) {
        return until(view, [&] {
            return renderer.counters().pictures >= pictures && renderer.counters().idle;
        });
    }
    bool rest(const RenderView& view) {
        if (!finish(view)) return false;
        for (int i = 0; i < 15; ++i) {
            frame(view);
            if (!seen()) return false;
        }
        return finish(view);
    }

    TracedRenderer renderer;

private:
    int count_ = 0;
};

RenderView shownView(TracedRenderer& renderer) {
    return {renderer.newest()->camera, renderer.newest()->T_world_camera};
}

double degreesBetween(const RenderView& a, const RenderView& b) {
    const Eigen::Vector3d &from = a.T_world_camera.translation, &to = b.T_world_camera.translation;
    return std::atan2(from.cross(to).norm(), from.dot(to)) * 180 / std::numbers::pi;
}

TEST(TracedRenderer, GivesTheSamePictureForBothSlicingMethodsAndAnyThreadCount) {
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    const auto scene = render_scenes::stillLife();
    const PathTracer tracer(scene);
    std::vector<std::uint32_t> all(kRenderSize.width * kRenderSize.height);
    std::iota(all.begin(), all.end(), 0U);
    Film film(kRenderSize);
    tracer.trace(view, all, 16, film);
    RenderedPicture truth;
    resolve(film, view, {}, truth, true);
    for (const Slicing slicing : {Slicing::Time, Slicing::Spatial})
        for (const int threads : {1, 2, 5}) {
            TracedRendererOptions options = quick();
            options.slices.slicing = slicing;
            options.threads = threads;
            options.policy.history = false;
            Frames frames(options);
            frames.renderer.setScene(scene);
            ASSERT_TRUE(frames.rest(view));
            const RenderedPicture* picture = frames.renderer.newest();
            ASSERT_NE(picture, nullptr);
            EXPECT_EQ(picture->colour, truth.colour);
            EXPECT_EQ(picture->depth, truth.depth);
            EXPECT_EQ(picture->id, truth.id);
            EXPECT_EQ(picture->samples, 16);
        }
}

TEST(TracedRenderer, IsIdleWhenThePictureIsFinishedAndTheCameraRests) {
    TracedRendererOptions options = quick();
    options.slices.samples = 4096;
    options.slices.threshold = 1e6;  // so high that a pixel is finished once its error is known
    Frames frames(options);
    EXPECT_TRUE(frames.renderer.counters().idle);
    frames.renderer.setScene(render_scenes::stillLife());
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    ASSERT_TRUE(frames.rest(view));
    const RenderCounters before = frames.renderer.counters();
    EXPECT_LE(before.samples, 2 * 48U * 36U * 4U)
        << "all pixels have little noise after four samples";
    const RenderedPicture* shown = frames.renderer.newest();
    for (int i = 0; i < 20; ++i)
        frames.frame(view);
    EXPECT_EQ(frames.renderer.counters().samples, before.samples);
    EXPECT_EQ(frames.renderer.counters().cpuMs, before.cpuMs);
    EXPECT_EQ(frames.renderer.newest(), shown);
    EXPECT_EQ(before.progress, 1);
}

TEST(TracedRenderer, IsNotIdleBeforeTheFirstPictureIsFinished) {
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    for (int i = 0; i < 6; ++i) {
        Frames frames(quick());
        frames.renderer.setScene(render_scenes::stillLife());
        frames.renderer.update(view, frames.now());
        const auto end = steady_clock::now() + std::chrono::seconds(60);
        RenderCounters counters;
        while (counters.pictures == 0 && steady_clock::now() < end) {
            counters = frames.renderer.counters();
            const bool seen = counters.frame >= frames.now();
            ASSERT_FALSE(seen && counters.idle && counters.pictures == 0);
        }
        EXPECT_EQ(counters.pictures, 1U);
    }
}

TEST(TracedRenderer, CameraAtRestNeverGetsANoisierPicture) {
    Frames frames(quick());
    frames.renderer.setScene(render_scenes::stillLife());
    double samples = 0;
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    EXPECT_TRUE(frames.until(view, [&] {
        const RenderedPicture* picture = frames.renderer.newest();
        const double now = picture != nullptr ? picture->samples : 0;
        EXPECT_GE(now, samples);
        samples = now;
        return now == 16;
    }));
}

TEST(TracedRenderer, SleepsWhenTheFramesBudgetIsUsedUp) {
    TracedRendererOptions options = quick();
    options.slices.samples = 1 << 20;
    options.budgetMs = 2;
    Frames frames(options);
    frames.renderer.setScene(render_scenes::stillLife());
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    // On a busy machine, frames may use less than their budget, because the threads have a low
    // priority. The mean must not exceed the budget by more than a tenth.
    int shown = 0;
    ASSERT_TRUE(frames.until(
        view, [&] { return ++shown > 300 && frames.renderer.counters().budget.mean > 0; }));
    EXPECT_LE(frames.renderer.counters().budget.mean, 1.1);
    const double used = frames.renderer.counters().cpuMs;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    frames.frame(view);  // from now on, counters() includes the time before this frame
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    // The limit is the budget of 20 frames, because the counters lag by some frames. Threads that
    // did not sleep would use the budget of hundreds of frames.
    EXPECT_LE(frames.renderer.counters().cpuMs - used, 20 * options.budgetMs);
}

TEST(TracedRenderer, TheDestructorInterruptsTracing) {
    TracedRendererOptions options = quick();
    options.slices.samples = 1 << 20;
    options.budgetMs = 1e6;
    for (const Slicing slicing : {Slicing::Time, Slicing::Spatial})
        for (int i = 0; i < 5; ++i) {
            options.slices.slicing = slicing;
            auto frames = std::make_unique<Frames>(options);
            frames->renderer.setScene(render_scenes::stillLife());
            HoleRequest request{render_scenes::viewFrom(kRenderSize, 30), {700, 800, 900}, 256};
            frames->renderer.requestHoles(request);
            for (int k = 0; k < 3 * i; ++k)
                frames->frame(render_scenes::viewFrom(kRenderSize, 20 + 5 * k));
            const auto begin = steady_clock::now();
            frames.reset();
            // Without the interruption, the destructor would wait for minutes.
            EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds(30));
        }
}

TEST(TracedRenderer, CameraMotionBeyondTheLimitStartsANewPicture) {
    Frames frames(quick());
    frames.renderer.setScene(render_scenes::stillLife());
    const RenderView first = render_scenes::viewFrom(kRenderSize, 20),
                     other = render_scenes::viewFrom(kRenderSize, 29);
    ASSERT_TRUE(frames.finish(first));
    for (int i = 0; i < 20; ++i)
        frames.frame(render_scenes::viewFrom(kRenderSize, i % 2 == 0 ? 20.8 : 19.2));
    EXPECT_EQ(degreesBetween(shownView(frames.renderer), first), 0)
        << "0.8 degrees do not require a new picture";
    ASSERT_TRUE(frames.finish(other, 2));
    EXPECT_LT(degreesBetween(shownView(frames.renderer), other), 4);
}

TEST(TracedRenderer, MakesTheNextPictureForAPredictedView) {
    TracedRendererOptions options = quick();
    options.policy.samplesToReplace = 16;
    options.budgetMs = 1;
    Frames frames(options);
    frames.renderer.setScene(render_scenes::stillLife());
    ASSERT_TRUE(frames.finish(render_scenes::viewFrom(kRenderSize, 0)));
    const Timestamp first = *frames.renderer.counters().shownSince;
    std::map<Timestamp, double> azimuths;
    double azimuth = 0;
    Timestamp chosen = first;
    while (chosen == first && azimuth < 200) {
        azimuth += 0.25;
        frames.frame(render_scenes::viewFrom(kRenderSize, azimuth));
        azimuths[frames.now()] = azimuth;
        ASSERT_TRUE(frames.seen()) << "each frame must arrive, so that a velocity can be measured";
        chosen = *frames.renderer.counters().shownSince;
    }
    ASSERT_TRUE(azimuths.contains(chosen));
    const Eigen::Vector3d at = shownView(frames.renderer).T_world_camera.translation;
    EXPECT_GT(std::atan2(at.y(), at.x()) * 180 / std::numbers::pi, azimuths[chosen] + 0.2);
}

TEST(TracedRenderer, AnswersTheNewestHoleRequest) {
    Frames frames(quick());
    const auto scene = render_scenes::stillLife();
    frames.renderer.setScene(scene);
    EXPECT_EQ(frames.renderer.takeHoles(), nullptr);
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    ASSERT_TRUE(frames.finish(view));
    HoleRequest request;
    for (int i = 0; i < 8; ++i) {
        request = {render_scenes::viewFrom(kRenderSize, 20 + i),
                   {400, 401, 500U + static_cast<unsigned>(i)},
                   8};
        frames.renderer.requestHoles(request);
    }
    const HoleAnswer* last = nullptr;
    ASSERT_TRUE(frames.until(view, [&] {
        if (const HoleAnswer* answer = frames.renderer.takeHoles()) last = answer;
        return last != nullptr && last->pixels.back() == 507;
    }));
    EXPECT_EQ(last->samples, 8);
    const RenderView there = render_scenes::viewFrom(kRenderSize, 27);
    EXPECT_EQ(last->view.T_world_camera.translation, there.T_world_camera.translation);
    Film film(kRenderSize);
    const PathTracer tracer(scene);
    tracer.trace(there, last->pixels, 8, film);
    for (std::size_t i = 0; i < last->pixels.size(); ++i)
        EXPECT_EQ(last->colour[i], film.resolved(last->pixels[i], {}).colour);
    EXPECT_EQ(frames.renderer.takeHoles(), nullptr) << "an answer must be given only once";
}

TEST(TracedRenderer, HoleRequestsDoNotPreventAFinishedPicture) {
    TracedRendererOptions options = quick();
    options.budgetMs = 2;
    Frames frames(options);
    frames.renderer.setScene(render_scenes::stillLife());
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    HoleRequest request;
    std::uint64_t answers = 0;
    EXPECT_TRUE(frames.until(view, [&] {
        request.view = view;
        request.samples = 4;
        request.pixels.resize(kRenderSize.width * kRenderSize.height);
        std::iota(request.pixels.begin(), request.pixels.end(), 0U);
        frames.renderer.requestHoles(request);
        answers += frames.renderer.takeHoles() != nullptr ? 1 : 0;
        return frames.renderer.counters().pictures >= 1 && answers >= 1;
    }));
}

TEST(TracedRenderer, InvalidSceneIsReportedAndTheOldSceneStays) {
    Frames frames(quick());
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    frames.renderer.setScene(render_scenes::stillLife());
    ASSERT_TRUE(frames.finish(view));
    Scene broken = *render_scenes::stillLife();
    broken.objects[0].scale = std::nanf("");
    frames.renderer.setScene(std::make_shared<Scene>(broken));
    std::optional<std::string> error;
    ASSERT_TRUE(
        frames.until(view, [&] { return (error = frames.renderer.takeError()).has_value(); }));
    EXPECT_FALSE(error->empty());
    EXPECT_FALSE(frames.renderer.takeError().has_value()) << "an error must be given only once";
    EXPECT_TRUE(frames.finish(render_scenes::viewFrom(kRenderSize, 40), 2));
}

TEST(TracedRenderer, NewObjectsOrLightStartAPictureButSmallChangesDoNot) {
    Frames frames(quick());
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    auto scene = std::make_shared<Scene>(*render_scenes::stillLife());
    frames.renderer.setScene(scene);
    ASSERT_TRUE(frames.finish(view));
    const auto set = [&](const Scene& next) {
        frames.renderer.setScene(std::make_shared<Scene>(next));
    };
    Scene next = *scene;
    next.lighting.sun->irradiance *= 1.01F;
    set(next);
    for (int i = 0; i < 30; ++i)
        frames.frame(view);
    EXPECT_EQ(frames.renderer.counters().pictures, 1U);
    next.lighting.sun->irradiance *= 3.0F;
    set(next);
    EXPECT_TRUE(frames.finish(view, 2));
    next.objects.pop_back();
    set(next);
    EXPECT_TRUE(frames.finish(view, 3));
}

TEST(TracedRenderer, WithoutASceneThePictureIsEmpty) {
    Frames frames(quick());
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    frames.renderer.setScene(render_scenes::stillLife());
    ASSERT_TRUE(frames.finish(view));
    frames.renderer.setScene(nullptr);
    ASSERT_TRUE(frames.finish(view, 2));
    for (const std::uint8_t id : frames.renderer.newest()->id)
        ASSERT_EQ(id, 0);
}

TEST(TracedRenderer, InvalidViewsAreIgnored) {
    Frames frames(quick());
    frames.renderer.setScene(render_scenes::stillLife());
    const RenderView view = render_scenes::viewFrom(kRenderSize, 20);
    std::vector<RenderView> broken(3, view);
    broken[0].T_world_camera.rotation.w() = std::nan("");
    broken[1].T_world_camera.rotation.coeffs().setZero();
    broken[2].camera.fx = 0;
    for (const RenderView& odd : broken)
        frames.frame(odd);
    EXPECT_EQ(frames.renderer.newest(), nullptr);
    ASSERT_TRUE(frames.finish(view));
    for (const RenderView& odd : broken)
        frames.frame(odd);
    EXPECT_EQ(frames.renderer.counters().pictures, 1U);
}

TEST(TracedRenderer, OptionsOutOfRangeAreRefused) {
    const auto refused = [](const std::function<void(TracedRendererOptions&)>& change) {
        TracedRendererOptions options;
        change(options);
        EXPECT_THROW(TracedRenderer{options}, std::invalid_argument);
    };
    refused([](TracedRendererOptions& o) { o.threads = 0; });
    refused([](TracedRendererOptions& o) { o.budgetMs = std::nan(""); });
    refused([](TracedRendererOptions& o) { o.slices.samples = 0; });
    refused([](TracedRendererOptions& o) { o.tracer.maxDepth = 0; });
    refused([](TracedRendererOptions& o) { o.policy.limits.turnDegrees = 0; });
    refused([](TracedRendererOptions& o) { o.policy.samplesToReplace = 0; });
    refused([](TracedRendererOptions& o) { o.policy.shownWithin = -1; });
    refused([](TracedRendererOptions& o) { o.policy.shownWithin = std::nan(""); });
    refused([](TracedRendererOptions& o) { o.lightChange = std::nan(""); });
    refused([](TracedRendererOptions& o) { o.holeShare = 1.5; });
    refused([](TracedRendererOptions& o) { o.exposure.scale = 0; });
    refused([](TracedRendererOptions& o) { o.prediction.seconds = -1; });
}

}  // namespace
}  // namespace mfar
