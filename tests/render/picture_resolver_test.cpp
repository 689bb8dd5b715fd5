#include "pipeline/render/picture_resolver.h"
#include "tests/render/render_scenes.h"
#include "tests/render/still_life.h"

#include <gtest/gtest.h>

#include <vector>

namespace mfar {
namespace {

constexpr Size kResolvedSize{64, 48};

/// The parameter is true if the noise filter is used.
struct PictureResolving : testing::TestWithParam<bool> {
    PictureResolving()
        : view(render_scenes::viewFrom(kResolvedSize, 20)), tracer(render_scenes::stillLife()),
          film(render_scenes::traced(tracer, view, 2)) {}

    RenderView view;
    PathTracer tracer;
    Film film;
};

void expectSame(const RenderedPicture& a, const RenderedPicture& b) {
    EXPECT_EQ(a.colour, b.colour);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.id, b.id);
    EXPECT_NEAR(a.samples, b.samples, 1e-9);
}

TEST_P(PictureResolving, OrderOfPortionsDoesNotChangeThePicture) {
    RenderedPicture whole, parts;
    resolve(film, view, {}, whole, GetParam());
    // Values of an earlier picture, which must be overwritten.
    parts.colour.assign(kResolvedSize.width * kResolvedSize.height, {1, 2, 3, 4});
    parts.id.assign(parts.colour.size(), 7);
    PictureResolver resolver;
    resolver.begin(film, view, tracer.bounds(view), {}, GetParam(), parts);
    int portions = 0;
    while (!resolver.complete()) {
        std::vector<PictureResolver::Portion> out;
        while (resolver.hasNext())
            out.push_back(resolver.next(200));
        ASSERT_FALSE(out.empty());
        const int stage = resolver.stage();
        for (auto portion = out.rbegin(); portion != out.rend(); ++portion) {
            EXPECT_EQ(resolver.stage(), stage)
                << "a stage began before the previous stage was finished";
            resolver.run(*portion);
            resolver.done(*portion);
            ++portions;
        }
    }
    EXPECT_GT(portions, 3);
    expectSame(parts, whole);
}

TEST_P(PictureResolving, EmptyBoundsGiveAnEmptyPicture) {
    RenderedPicture out;
    PictureResolver resolver;
    resolver.begin(film, view, {}, {}, GetParam(), out);
    while (!resolver.complete()) {
        const PictureResolver::Portion portion = resolver.next(1);
        resolver.run(portion);
        resolver.done(portion);
    }
    EXPECT_EQ(out.id, std::vector<std::uint8_t>(out.id.size(), 0));
    EXPECT_EQ(out.samples, 0);
}

INSTANTIATE_TEST_SUITE_P(Filtered, PictureResolving, testing::Bool());

}  // namespace
}  // namespace mfar
