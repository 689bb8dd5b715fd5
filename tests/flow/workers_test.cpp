#include "base/workers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace mfar {
namespace {

using Parts = std::vector<std::pair<int, int>>;

Parts partsOf(Workers& workers, int end, int grain) {
    std::mutex mutex;
    Parts parts;
    workers.forRange(end, grain, [&](int first, int last) {
        const std::scoped_lock lock(mutex);
        parts.emplace_back(first, last);
    });
    std::sort(parts.begin(), parts.end());
    return parts;
}

TEST(Workers, EveryIndexIsProcessedOnce) {
    for (int threads = 1; threads <= 4; ++threads) {
        Workers workers(threads);
        EXPECT_EQ(workers.count(), threads);
        for (const int end : {1, 2, 3, 15, 16, 17, 100, 1001}) {
            std::vector<std::atomic<int>> visits(end);
            workers.forRange(end, 1, [&](int first, int last) {
                for (int i = first; i < last; ++i)
                    ++visits[i];
            });
            for (int i = 0; i < end; ++i)
                ASSERT_EQ(visits[i], 1) << i << " of " << end << ", " << threads << " threads";
        }
    }
}

TEST(Workers, PartsAreConsecutiveAndNoShorterThanTheGrain) {
    for (int threads = 1; threads <= 4; ++threads) {
        Workers workers(threads);
        for (const int grain : {1, 4, 7, 64}) {
            for (const int end : {1, 7, 10, 64, 65, 333}) {
                const Parts parts = partsOf(workers, end, grain);
                ASSERT_FALSE(parts.empty());
                int next = 0;
                for (const auto& [first, last] : parts) {
                    ASSERT_EQ(first, next);
                    ASSERT_GT(last, first);
                    ASSERT_TRUE(last == end || last - first >= grain);
                    next = last;
                }
                ASSERT_EQ(next, end);
            }
        }
    }
}

TEST(Workers, AnEmptyLoopCallsNothing) {
    Workers workers(3);
    EXPECT_TRUE(partsOf(workers, 0, 1).empty());
    EXPECT_TRUE(partsOf(workers, -5, 1).empty());
    EXPECT_EQ(partsOf(workers, 1, 1).size(), 1U);
}

// A part that is left over from an earlier loop, or run twice, would change the sum of the next
// loop.
TEST(Workers, ConsecutiveLoopsDoNotAffectEachOther) {
    for (int threads = 1; threads <= 4; ++threads) {
        Workers workers(threads);
        for (int loop = 1; loop <= 3000; ++loop) {
            const int end = loop % 37 + 1;
            std::atomic<int> sum = 0;
            workers.forRange(end, 1, [&](int first, int last) {
                for (int i = first; i < last; ++i)
                    sum += i * loop;
            });
            ASSERT_EQ(sum, end * (end - 1) / 2 * loop);
        }
    }
}

// The caller must see what the loop's body wrote, without a lock. ThreadSanitizer checks this.
TEST(Workers, ResultsAreVisibleToTheCaller) {
    Workers workers(4);
    std::vector<int> values(500);
    for (int loop = 0; loop < 200; ++loop) {
        workers.forRange(500, 1, [&](int first, int last) {
            for (int i = first; i < last; ++i)
                ++values[i];
        });
        ASSERT_EQ(std::count(values.begin(), values.end(), loop + 1), 500);
    }
}

TEST(Workers, OtherThreadsShareTheWork) {
    Workers workers(2);
    std::mutex mutex;
    std::set<std::thread::id> seen;
    std::atomic<bool> both = false;
    workers.forRange(2, 1, [&](int, int) {
        {
            const std::scoped_lock lock(mutex);
            seen.insert(std::this_thread::get_id());
            if (seen.size() == 2) both = true;
        }
        both.notify_all();
        both.wait(false);
    });
    EXPECT_EQ(seen.size(), 2U);
    EXPECT_TRUE(seen.contains(std::this_thread::get_id()));
}

TEST(Workers, DefaultIsOneThreadPerProcessorUpToFour) {
    const int processors = static_cast<int>(std::thread::hardware_concurrency());
    EXPECT_EQ(Workers().count(), std::clamp(processors, 1, 4));
}

TEST(Workers, UnusedWorkersCanBeDestroyed) {
    for (int i = 0; i < 200; ++i)
        const Workers workers(4);
}

}  // namespace
}  // namespace mfar
