#include "daemon/mailbox.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace mfar {
namespace {

TEST(Mailbox, TheReceiverGetsTheNewestItemAndReplacedItemsAreCounted) {
    Mailbox<int> box(HandOver::NewestWins);
    EXPECT_EQ(box.put(1), Mailbox<int>::Put::Stored);
    EXPECT_EQ(box.put(2), Mailbox<int>::Put::Replaced);
    EXPECT_EQ(box.put(3), Mailbox<int>::Put::Replaced);
    EXPECT_EQ(box.take(), 3);
    EXPECT_EQ(box.dropped(), 2U);
    EXPECT_EQ(box.tryTake(), std::nullopt);
}

TEST(Mailbox, ItemsMayBeMoveOnly) {
    Mailbox<std::unique_ptr<int>> box(HandOver::NewestWins);
    box.put(std::make_unique<int>(7));
    EXPECT_EQ(**box.take(), 7);
}

struct Parcel {
    std::string letter;
    std::string kept;
    void supersede(Parcel&& older) { kept = older.kept + older.letter; }
};

TEST(Mailbox, ANewerItemInheritsDataFromTheReplacedItem) {
    Mailbox<Parcel> box(HandOver::NewestWins);
    box.put({"a", ""});
    box.put({"b", ""});
    box.put({"c", ""});
    const auto parcel = box.take();
    EXPECT_EQ(parcel->letter, "c");
    EXPECT_EQ(parcel->kept, "ab");
}

TEST(Mailbox, InLosslessModeEveryItemIsHandedOverInOrder) {
    constexpr int kItems = 2000;
    Mailbox<int> box(HandOver::Lossless);
    std::vector<int> received;
    std::jthread receiver([&] {
        while (const auto item = box.take())
            received.push_back(*item);
    });
    for (int i = 0; i < kItems; ++i)
        ASSERT_EQ(box.put(i), Mailbox<int>::Put::Stored);
    box.finish();
    receiver.join();
    ASSERT_EQ(received.size(), static_cast<std::size_t>(kItems));
    for (int i = 0; i < kItems; ++i)
        EXPECT_EQ(received[i], i);
    EXPECT_EQ(box.dropped(), 0U);
}

TEST(Mailbox, UnderLoadEveryReplacedItemIsCounted) {
    constexpr int kItems = 2000;
    Mailbox<int> box(HandOver::NewestWins);
    int received = 0;
    int last = -1;
    std::jthread receiver([&] {
        while (const auto item = box.take()) {
            EXPECT_GT(*item, last);
            last = *item;
            ++received;
        }
    });
    for (int i = 0; i < kItems; ++i)
        box.put(i);
    box.finish();
    receiver.join();
    EXPECT_EQ(last, kItems - 1);
    EXPECT_EQ(received + static_cast<int>(box.dropped()), kItems);
}

TEST(Mailbox, InLosslessModeTheSenderWaitsForTheReceiver) {
    Mailbox<int> box(HandOver::Lossless);
    std::atomic<int> working{0};
    std::jthread receiver([&] {
        while (box.take()) {
            ++working;
            std::this_thread::yield();
            --working;
        }
    });
    for (int i = 0; i < 500; ++i) {
        box.put(i);
        ASSERT_EQ(working, 0) << "an item was sent while the receiver was still working";
    }
    box.finish();
}

TEST(Mailbox, TimedWaitDistinguishesTimeoutFromEnd) {
    Mailbox<int> box(HandOver::NewestWins);
    EXPECT_EQ(box.takeWithin(std::chrono::milliseconds(1)), std::nullopt);
    EXPECT_FALSE(box.over());
    box.put(5);
    box.finish();
    EXPECT_FALSE(box.over());
    EXPECT_EQ(box.takeWithin(std::chrono::milliseconds(1)), 5);
    EXPECT_TRUE(box.over());
}

TEST(Mailbox, TheLastItemIsDeliveredAfterFinish) {
    Mailbox<int> box(HandOver::NewestWins);
    box.put(5);
    box.finish();
    EXPECT_EQ(box.take(), 5);
    EXPECT_EQ(box.take(), std::nullopt);
}

TEST(Mailbox, CloseWakesAWaitingReceiver) {
    Mailbox<int> box(HandOver::Lossless);
    std::jthread receiver([&] {
        EXPECT_EQ(box.take(), 1);
        EXPECT_EQ(box.take(), std::nullopt);
    });
    // put() returns when the receiver asks for the next item, just before it waits.
    EXPECT_EQ(box.put(1), Mailbox<int>::Put::Stored);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    box.close();
}

TEST(Mailbox, CloseWakesAWaitingSenderAndDestroysTheItem) {
    using Item = std::shared_ptr<int>;
    Item item = std::make_shared<int>(1);
    Mailbox<Item> box(HandOver::Lossless);
    std::jthread sender([&] { EXPECT_EQ(box.put(item), Mailbox<Item>::Put::Closed); });
    while (item.use_count() < 2)
        std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    box.close();
    sender.join();
    EXPECT_EQ(item.use_count(), 1);
    EXPECT_EQ(box.put(item), Mailbox<Item>::Put::Closed);
}

}  // namespace
}  // namespace mfar
