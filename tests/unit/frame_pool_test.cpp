#include "hal/frame.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <thread>

namespace mfar {
namespace {

using std::chrono::milliseconds;

TEST(FramePool, LendsABufferAgainOnlyAfterItWasReturned) {
    FramePool pool({4, 3}, PixelFormat::Rgba8, 2);
    const auto a = pool.acquire(milliseconds(0));
    const auto b = pool.acquire(milliseconds(0));
    ASSERT_TRUE(a && b);
    EXPECT_NE(a->data, b->data);
    EXPECT_EQ(a->stride, 16U);
    EXPECT_FALSE(pool.acquire(milliseconds(0)).has_value());
    pool.giveBack(*a);
    const auto again = pool.acquire(milliseconds(0));
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->data, a->data);
}

TEST(FramePool, DestroyingTheFrameReturnsItsBufferAndMovingItDoesNot) {
    FramePool pool({4, 3}, PixelFormat::Gray8, 1);
    const auto slot = pool.acquire(milliseconds(0));
    ASSERT_TRUE(slot.has_value());
    {
        Frame first = pool.lend(*slot, {42});
        Frame second = std::move(first);
        EXPECT_EQ(second.time().ns, 42);
        EXPECT_EQ(second.view().size, (Size{4, 3}));
        EXPECT_EQ(second.view().format, PixelFormat::Gray8);
        EXPECT_FALSE(pool.acquire(milliseconds(0)).has_value());
    }
    const auto again = pool.acquire(milliseconds(0));
    EXPECT_TRUE(again.has_value());
    EXPECT_FALSE(pool.acquire(milliseconds(0)).has_value()) << "a buffer was returned twice";
}

TEST(FramePool, AssigningAFrameReturnsTheBufferItHeld) {
    FramePool pool({4, 3}, PixelFormat::Gray8, 2);
    Frame held = pool.lend(*pool.acquire(milliseconds(0)), {1});
    held = pool.lend(*pool.acquire(milliseconds(0)), {2});
    EXPECT_EQ(held.time().ns, 2);
    EXPECT_TRUE(pool.acquire(milliseconds(0)).has_value());
    EXPECT_FALSE(pool.acquire(milliseconds(0)).has_value());
}

TEST(FramePool, FramesOutliveThePool) {
    std::unique_ptr<Frame> frame;
    {
        FramePool pool({4, 3}, PixelFormat::Gray8, 1);
        const auto slot = pool.acquire(milliseconds(0));
        std::memset(slot->data, 7, 12);
        frame = std::make_unique<Frame>(pool.lend(*slot, {1}));
    }
    EXPECT_EQ(frame->view().data[11], 7);
    frame.reset();
}

TEST(FramePool, AWaitingThreadGetsTheReturnedBuffer) {
    FramePool pool({4, 3}, PixelFormat::Gray8, 1);
    auto frame = std::make_unique<Frame>(pool.lend(*pool.acquire(milliseconds(0)), {1}));
    std::thread consumer([&] { frame.reset(); });
    constexpr std::chrono::seconds kLimit{60};
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(pool.acquire(kLimit).has_value());
    EXPECT_LT(std::chrono::steady_clock::now() - start, kLimit / 2);
    consumer.join();
}

}  // namespace
}  // namespace mfar
