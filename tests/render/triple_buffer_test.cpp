#include "pipeline/slices/triple_buffer.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace mfar {
namespace {

TEST(TripleBuffer, ReaderGetsTheNewestValue) {
    TripleBuffer<int> buffer;
    EXPECT_FALSE(buffer.fetch());
    for (const int value : {1, 2, 3}) {
        buffer.back() = value;
        buffer.publish();
    }
    EXPECT_TRUE(buffer.fetch());
    EXPECT_EQ(buffer.front(), 3);
    EXPECT_FALSE(buffer.fetch());
    EXPECT_EQ(buffer.front(), 3);
}

TEST(TripleBuffer, ValueOfTheReaderStaysAndMemoryIsReused) {
    TripleBuffer<std::vector<int>> buffer;
    for (int i = 0; i < 3; ++i) {  // gives each of the three values its memory
        buffer.back().assign(100, i);
        buffer.publish();
        buffer.fetch();
    }
    const int* held = buffer.front().data();
    for (int i = 10; i < 20; ++i) {
        const int* reused = buffer.back().data();
        buffer.back().assign(100, i);
        EXPECT_EQ(buffer.back().data(), reused);
        EXPECT_NE(reused, held);
        buffer.publish();
        EXPECT_EQ(buffer.front().data(), held);
        EXPECT_EQ(buffer.front()[99], 2);
    }
    EXPECT_TRUE(buffer.fetch());
    EXPECT_NE(buffer.front().data(), held) << "fetch() must change to another of the three values";
    EXPECT_EQ(buffer.front()[99], 19);
}

TEST(TripleBuffer, ThreadsSeeCompleteValuesInOrder) {
    struct Pair {
        int a = 0, b = 0;
    };
    constexpr int kLast = 20000;
    TripleBuffer<Pair> buffer;
    std::jthread writer([&] {
        for (int i = 1; i <= kLast; ++i) {
            buffer.back() = {i, -i};
            buffer.publish();
        }
    });
    int last = 0;
    while (last < kLast) {
        if (!buffer.fetch()) {
            std::this_thread::yield();
            continue;
        }
        ASSERT_EQ(buffer.front().a, -buffer.front().b);
        ASSERT_GT(buffer.front().a, last);
        last = buffer.front().a;
    }
}

}  // namespace
}  // namespace mfar
