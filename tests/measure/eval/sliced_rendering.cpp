#include "tests/measure/eval/sliced_rendering.h"

#include "base/thread_priority.h"
#include "pipeline/render/picture_resolver.h"
#include "pipeline/slices/traced_renderer.h"
#include "tests/render/still_life.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

namespace mfar::eval {
namespace {

constexpr double kAzimuth = 25;
constexpr std::uint32_t kTruthSeed = 1;
constexpr int kParts = 16;
constexpr std::int64_t kPortion = 256;

class SlicedPicture {
public:
    SlicedPicture(const SlicedScene& scene, const SliceOptions& options)
        : film(scene.view.camera.size), slices(options), scene_(scene) {
        slices.begin(scene.bounds, scene.view.camera.size);
    }

    /// Traces the next slice, which has at most `most` samples, and returns the number of its
    /// samples. If slice.samples is 0, a ray through each pixel's centre counts as one sample.
    std::int64_t trace(std::int64_t most) {
        const double begin = threadCpuMs();
        const Slice slice = slices.next(most);
        if (slice.pixels.empty()) return 0;
        scene_.tracer->trace(scene_.view, slice.pixels, slice.samples, film);
        slices.done(slice, [&](std::uint32_t pixel) {
            return PixelState{film.error(pixel), static_cast<float>(film.samples(pixel)), false};
        });
        ms += threadCpuMs() - begin;
        return static_cast<std::int64_t>(slice.pixels.size()) * std::max(slice.samples, 1);
    }
    [[nodiscard]] ErrorAt state() const {
        const auto pixels = static_cast<double>(std::max<std::size_t>(slices.pixels(), 1));
        return {static_cast<double>(slices.traced()) / pixels, ms, scene_.error(film),
                scene_.error(film, true)};
    }

    Film film;
    Slices slices;
    double ms = 0;

private:
    const SlicedScene& scene_;
};

}  // namespace

SlicedScene::SlicedScene(Size size, int truthSamples, int threads)
    : view(render_scenes::viewFrom(size, kAzimuth)) {
    const auto scene = render_scenes::stillLife();
    tracer = std::make_shared<PathTracer>(scene);
    bounds = tracer->bounds(view);
    PathTracerOptions other;
    other.seed = kTruthSeed;
    const PathTracer exact(scene, other);
    Film film(size);
    std::vector<std::jthread> workers;
    for (int part = 0; part < threads; ++part)
        workers.emplace_back([&, part] {
            std::vector<std::uint32_t> pixels;
            for (int y = bounds.y0 + part; y < bounds.y1; y += threads)
                for (int x = bounds.x0; x < bounds.x1; ++x)
                    pixels.push_back(static_cast<std::uint32_t>(y * size.width + x));
            exact.trace(view, pixels, truthSamples, film);
        });
    workers.clear();
    resolve(film, view, {}, truth);
}

double SlicedScene::error(const Film& film, bool filter) const {
    RenderedPicture picture;
    resolve(film, view, {}, picture, filter);
    double squares = 0, count = 0;
    for (int y = bounds.y0; y < bounds.y1; ++y)
        for (int x = bounds.x0; x < bounds.x1; ++x) {
            const auto i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(view.camera.size.width) +
                static_cast<std::size_t>(x);
            for (std::size_t c = 0; c < 4; ++c) {
                const double off = picture.colour[i][c] - truth.colour[i][c];
                squares += off * off;
                count += 1;
            }
        }
    return count > 0 ? std::sqrt(squares / count) : 0;
}

std::vector<ErrorAt> slicedErrors(const SlicedScene& scene, const SliceOptions& options) {
    SlicedPicture picture(scene, options);
    std::vector<ErrorAt> out;
    const bool time = options.slicing == Slicing::Time;
    double next = time ? 1 : 1.0 / kParts;
    while (picture.trace(kPortion) > 0) {
        if (time && !picture.slices.turnComplete()) continue;
        const double reached = time ? picture.slices.samples() : picture.slices.progress();
        if (reached < next) continue;
        out.push_back(picture.state());
        next = 2 * reached;
    }
    if (out.empty() || out.back().ms < picture.ms) out.push_back(picture.state());
    return out;
}

std::vector<ErrorAt> wholeErrors(const SlicedScene& scene, int samples) {
    std::vector<ErrorAt> out;
    for (int count = 1; count <= samples; count *= 2) {
        SlicedPicture picture(scene, {Slicing::Spatial, count, count, 0, 2});
        while (picture.trace(std::numeric_limits<std::int64_t>::max()) > 0) {
        }
        out.push_back(picture.state());
    }
    return out;
}

std::vector<double> frameTimes(const SlicedScene& scene, const SliceOptions& options, int frames) {
    SlicedPicture picture(scene, options);
    const int looks = options.slicing == Slicing::Time ? 1 : 0;
    const auto total =
        static_cast<std::int64_t>(picture.slices.pixels()) * (options.samples + looks);
    std::vector<double> out;
    std::int64_t traced = 0;
    for (int frame = 1; frame <= frames; ++frame) {
        const double begin = picture.ms;
        for (std::int64_t part = 1; part > 0 && traced < total * frame / frames; traced += part)
            part = picture.trace(std::min(kPortion, total * frame / frames - traced));
        out.push_back(picture.ms - begin);
    }
    return out;
}

BudgetRun budgetRun(const SliceOptions& slices, Size size, double budgetMs, int threads, int frames,
                    double degreesPerSecond) {
    using std::chrono::steady_clock;
    TracedRendererOptions options;
    options.slices = slices;
    options.budgetMs = budgetMs;
    options.threads = threads;
    TracedRenderer renderer(options);
    renderer.setScene(render_scenes::stillLife());
    const auto period = std::chrono::nanoseconds(1'000'000'000 / 30);
    steady_clock::time_point next = steady_clock::now();
    RenderCounters counters;
    // counters.budget.frames counts only frames in which the tracer has work and gets processor
    // time. The loop ends after 4 * frames + 60 frames, even if fewer than `frames` of them count.
    for (int frame = 0; counters.budget.frames < frames && frame < 4 * frames + 60; ++frame) {
        const double azimuth = kAzimuth + frame * degreesPerSecond / 30;
        renderer.update(render_scenes::viewFrom(size, azimuth), Timestamp{} + frame * period);
        std::this_thread::sleep_until(next += period);
        counters = renderer.counters();
    }
    return {counters.budget.mean, counters.budget.deviation, 1000 / counters.msPerSample};
}

}  // namespace mfar::eval
