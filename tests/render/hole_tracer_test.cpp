#include "pipeline/render/path_tracer.h"
#include "pipeline/render/picture_resolver.h"
#include "pipeline/slices/hole_tracer.h"
#include "tests/render/still_life.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mfar {
namespace {

constexpr Size kHoleSize{48, 36};
using PixelList = std::vector<std::uint32_t>;

HoleRequest requestFor(PixelList pixels, int samples) {
    return {render_scenes::viewFrom(kHoleSize, 20), std::move(pixels), samples};
}

HoleAnswer answered(HoleTracer& holes, const PathTracer& tracer, HoleRequest request,
                    std::int64_t portion) {
    holes.take(request);
    EXPECT_TRUE(holes.taken());
    holes.prepare();
    while (holes.tracing()) {
        const auto pixels = holes.next(portion);
        EXPECT_LE(
            pixels.size() * static_cast<std::size_t>(holes.request().samples),
            static_cast<std::size_t>(std::max<std::int64_t>(portion, holes.request().samples)));
        tracer.trace(holes.request().view, pixels, holes.request().samples, holes.film());
        holes.done(pixels);
    }
    EXPECT_TRUE(holes.complete());
    HoleAnswer out;
    holes.answer({}, out);
    EXPECT_TRUE(holes.idle());
    return out;
}

TEST(HoleTracer, AnswersMatchAPictureOfTheView) {
    const PathTracer tracer(render_scenes::stillLife());
    const RenderView view = render_scenes::viewFrom(kHoleSize, 20);
    PixelList all(kHoleSize.width * kHoleSize.height);
    for (std::uint32_t i = 0; i < all.size(); ++i)
        all[i] = i;
    Film film(kHoleSize);
    tracer.trace(view, all, 4, film);
    RenderedPicture truth;
    resolve(film, view, {}, truth);

    HoleTracer holes(10000);
    for (int round = 0; round < 2; ++round) {  // the second must not keep results of the first
        PixelList some;
        for (std::uint32_t i = 0; i < all.size(); i += 2 + round)
            some.push_back(i);
        const HoleAnswer answer = answered(holes, tracer, requestFor(some, 4), 100);
        ASSERT_EQ(answer.pixels, some);
        ASSERT_EQ(answer.colour.size(), some.size());
        ASSERT_EQ(answer.light.size(), some.size());
        int objects = 0;
        for (std::size_t i = 0; i < some.size(); ++i) {
            EXPECT_EQ(answer.colour[i], truth.colour[some[i]]);
            EXPECT_EQ(answer.depth[i], truth.depth[some[i]]);
            EXPECT_EQ(answer.id[i], truth.id[some[i]]);
            EXPECT_EQ(answer.light[i], truth.light[some[i]]);
            objects += answer.id[i] != 0 ? 1 : 0;
        }
        EXPECT_GT(objects, 20);
    }
    EXPECT_EQ(holes.answered(), all.size() / 2 + all.size() / 3);
}

TEST(HoleTracer, AnAnswerHasThePosesOfItsRequest) {
    const PathTracer tracer(render_scenes::stillLife());
    HoleTracer holes(100);
    HoleRequest request = requestFor({900}, 1);
    request.poses = {{Eigen::Quaterniond::Identity(), {1, 2, 3}}, {}};
    const HoleAnswer answer = answered(holes, tracer, request, 1);
    ASSERT_EQ(answer.poses.size(), 2U);
    EXPECT_EQ(answer.poses[0].translation, Eigen::Vector3d(1, 2, 3));
}

TEST(HoleTracer, EachPixelInsideThePictureIsTracedOnce) {
    const PathTracer tracer(render_scenes::stillLife());
    HoleTracer holes(100);
    const HoleAnswer answer = answered(
        holes, tracer, requestFor({900, 7, 7, 900, 3, 48 * 36, 4000000000U, 48 * 36 - 1}, 1), 1);
    EXPECT_EQ(answer.pixels, (PixelList{3, 7, 900, 48 * 36 - 1}));
}

TEST(HoleTracer, TooLargeRequestsAreReducedToTheLimits) {
    const PathTracer tracer(render_scenes::stillLife());
    HoleTracer holes(5);
    EXPECT_EQ(answered(holes, tracer, requestFor({1, 2, 3, 4, 5, 6, 7}, 1), 10).pixels.size(), 5U);
    EXPECT_EQ(answered(holes, tracer, requestFor({1}, 100000), 10).samples, kMostHoleSamples);
    EXPECT_EQ(answered(holes, tracer, requestFor({1}, -3), 10).samples, 1);
}

TEST(HoleTracer, InvalidViewsHaveNoPixels) {
    const PathTracer tracer(render_scenes::stillLife());
    HoleTracer holes(100);
    HoleRequest request = requestFor({1, 2, 3}, 1);
    request.view.T_world_camera.translation.x() = std::nan("");
    EXPECT_TRUE(answered(holes, tracer, request, 10).pixels.empty());
    request = requestFor({1, 2, 3}, 1);
    request.view.T_world_camera.rotation.coeffs().setZero();
    EXPECT_TRUE(answered(holes, tracer, request, 10).pixels.empty());
    request = requestFor({0, 1}, 1);
    request.view.camera.size = {0, 5};
    EXPECT_TRUE(answered(holes, tracer, request, 10).pixels.empty());
}

TEST(HoleTracer, RequestsForPicturesOfDifferentSizesAreAnswered) {
    const PathTracer tracer(render_scenes::stillLife());
    HoleTracer holes(100);
    EXPECT_EQ(answered(holes, tracer, requestFor({1000}, 1), 10).pixels.size(), 1U);
    HoleRequest larger{render_scenes::viewFrom({64, 64}, 20), {4000}, 1};
    EXPECT_EQ(answered(holes, tracer, larger, 10).pixels.size(), 1U);
    EXPECT_EQ(answered(holes, tracer, requestFor({4000}, 1), 10).pixels.size(), 0U);
}

}  // namespace
}  // namespace mfar
