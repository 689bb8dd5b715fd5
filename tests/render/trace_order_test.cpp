#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>

namespace mfar {
namespace {

using namespace render_scenes;

std::shared_ptr<const Scene> mixedScene() {
    auto out = std::make_shared<Scene>();
    Material metal, paint;
    metal.roughness = 0.3F;
    paint.metallic = 0;
    out->objects.push_back(objectOf(modelOf(sphere({0, 0, 0.5F}, 0.5F, 24), metal)));
    out->objects.push_back(objectOf(modelOf(sphere({0.8F, 0.2F, 0.3F}, 0.3F, 24), paint)));
    out->catcher = ground(3, 0.6F);
    out->lighting = {unevenLight(), Sun{Eigen::Vector3f(0.3F, 0.2F, 1).normalized(), {2, 2, 2}}};
    return out;
}

const RenderView kMixedView = lookingAt({0.5, -3, 2}, {0.3, 0, 0.3}, {48, 36}, 60);

void expectSame(const Film& a, const Film& b) {
    int different = 0;
    for (const std::uint32_t p : allPixels(a.size())) {
        const Film::Means m = a.means(p), n = b.means(p);
        different += !(m.object == n.object && m.with == n.with && m.without == n.without &&
                       m.objectShare == n.objectShare && a.error(p) == b.error(p));
    }
    EXPECT_EQ(different, 0);
    const RenderedPicture p = resolved(a, kMixedView), q = resolved(b, kMixedView);
    EXPECT_EQ(p.colour, q.colour);
    EXPECT_EQ(p.depth, q.depth);
    EXPECT_EQ(p.id, q.id);
}

TEST(TraceOrder, PortionSizesDoNotChangeThePicture) {
    const PathTracer tracer(mixedScene());
    const Film whole = traced(tracer, kMixedView, 8);
    Film cut(kMixedView.camera.size);
    std::vector<std::uint32_t> pixels = allPixels(kMixedView.camera.size);
    std::shuffle(pixels.begin(), pixels.end(), std::mt19937(4));
    const std::span<const std::uint32_t> all(pixels);
    tracer.trace(kMixedView, all.first(1000), 3, cut);
    tracer.trace(kMixedView, all.subspan(1000), 8, cut);
    for (const std::uint32_t pixel : all.first(1000))
        tracer.trace(kMixedView, std::span(&pixel, 1), 5, cut);
    expectSame(whole, cut);
}

TEST(TraceOrder, ThreadCountDoesNotChangeThePicture) {
    const PathTracer tracer(mixedScene());
    const Film alone = traced(tracer, kMixedView, 4);
    Film shared(kMixedView.camera.size);
    const std::vector<std::uint32_t> pixels = allPixels(kMixedView.camera.size);
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < 3; ++t)
            threads.emplace_back([&, t] {
                for (std::size_t i = t; i < pixels.size(); i += 3)
                    tracer.trace(kMixedView, std::span(&pixels[i], 1), 4, shared);
            });
    }
    expectSame(alone, shared);
}

TEST(TraceOrder, DifferentSeedsGiveDifferentPictures) {
    PathTracerOptions other;
    other.seed = 1;
    const Film a = traced(PathTracer(mixedScene()), kMixedView, 1);
    const Film b = traced(PathTracer(mixedScene(), other), kMixedView, 1);
    EXPECT_NE(resolved(a, kMixedView).colour, resolved(b, kMixedView).colour);
}

}  // namespace
}  // namespace mfar
