#include "base/heartbeats.h"
#include "daemon/filter_learning.h"
#include "tests/learn/sensor_pair.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <thread>

namespace mfar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct FilterLearningTest : testing::Test {
    ~FilterLearningTest() override { std::filesystem::remove(options.file); }

    static void show(FilterLearning& learning, int first, int last,
                     const SensorPair& pair = {.videoBlur = 1}) {
        for (int i = first; i <= last; ++i) {
            const twin::Grey sharp = sharpDiscs(i);
            showTo(learning, sharp, sharp, pair);
            ASSERT_TRUE(learning.finish(std::chrono::minutes(5)));
        }
    }

    // Each test has its own file, because tests run concurrently in separate processes.
    FilterLearningOptions options{std::filesystem::path(testing::TempDir()) /
                                      ("mfar-filters-" + std::to_string(::getpid()) + ".learned"),
                                  "video, still", true};
};

TEST_F(FilterLearningTest, LearnedFiltersAreReturnedOnce) {
    FilterLearning learning(options);
    EXPECT_NE(learning.takeFilters(), nullptr) << "the shipped filters must be returned";
    EXPECT_EQ(learning.takeFilters(), nullptr);
    show(learning, 1, 2);
    EXPECT_EQ(learning.counts().learner.stills, 2U);
    EXPECT_GT(learning.counts().learner.classes, 0);
    EXPECT_NE(learning.takeFilters(), nullptr);
    EXPECT_EQ(learning.takeFilters(), nullptr);
    EXPECT_THAT(learning.takeWarnings(), IsEmpty());
}

int highestNice() {
    int highest = -20;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
        const auto id = static_cast<id_t>(std::stoul(task.path().filename()));
        highest = std::max(highest, ::getpriority(PRIO_PROCESS, id));
    }
    return highest;
}

TEST_F(FilterLearningTest, LearningHasALowPriorityUnlessFramesWaitForIt) {
    const int before = highestNice();
    {
        FilterLearning learning(options);
        show(learning, 1, 1);
        EXPECT_EQ(highestNice(), before);
    }
    options.waits = false;
    FilterLearning learning(options);
    showTo(learning, sharpDiscs(1), sharpDiscs(1), {.videoBlur = 1});
    while (learning.counts().learner.stills == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_GT(highestNice(), before);
}

StereoRig discsRig() {
    StereoRig rig;
    rig.video = {{256, 192}, 240, 240, 127.5, 95.5, {}};
    rig.still = {{1024, 768}, 960, 960, 511.5, 383.5, {}};
    return rig;
}

/// Reports that a still will be replaced, then shows a second still of the same view, which
/// replaces it. The video is noisy.
void replace(FilterLearning& learning, unsigned seed) {
    const twin::Grey sharp = sharpDiscs(seed);
    const SensorPair noisy{.videoNoise = 4, .seed = seed};
    showReplacedTo(learning, sharp, sharp, noisy);
    showTo(learning, sharp, sharp, noisy);
    ASSERT_TRUE(learning.finish(std::chrono::minutes(5)));
}

TEST_F(FilterLearningTest, GuidanceIsLearnedFromTheOlderStillAndKeptAfterARestart) {
    options.rig = discsRig();
    {
        FilterLearning learning(options);
        show(learning, 1, 1, {.videoNoise = 4});
        EXPECT_EQ(learning.counts().learner.pairs, 0U) << "guidance needs an older still";
        replace(learning, 2);
        EXPECT_EQ(learning.counts().learner.pairs, 1U);
        EXPECT_GT(learning.counts().learner.guidance.still, 0.5F);
        EXPECT_GT(learning.takeFilters()->guidance().video, 0.5F);
        show(learning, 3, 3);
        EXPECT_EQ(learning.counts().learner.pairs, 1U)
            << "without a replaced still, no guidance is learned";
    }
    FilterLearning learning(options);
    EXPECT_EQ(learning.counts().learner.pairs, 1U);
    EXPECT_GT(learning.takeFilters()->guidance().video, 0.5F);
    learning.reset();
    ASSERT_TRUE(learning.finish(std::chrono::minutes(5)));
    EXPECT_FALSE(learning.takeFilters()->guidance().any());
    EXPECT_THAT(learning.takeWarnings(), IsEmpty());
}

TEST_F(FilterLearningTest, WithoutACalibrationNoGuidanceIsLearned) {
    FilterLearning learning(options);
    replace(learning, 2);
    EXPECT_EQ(learning.counts().learner.pairs, 0U);
    EXPECT_FALSE(learning.takeFilters()->guidance().any());
}

TEST_F(FilterLearningTest, LearningContinuesAfterARestart) {
    {
        FilterLearning learning(options);
        show(learning, 1, 2);
    }
    ASSERT_TRUE(std::filesystem::exists(options.file));
    FilterLearning learning(options);
    EXPECT_EQ(learning.counts().learner.stills, 2U);
    EXPECT_GT(learning.counts().learner.classes, 0);
    show(learning, 3, 3);
    EXPECT_EQ(learning.counts().learner.stills, 3U);
    EXPECT_THAT(learning.takeWarnings(), IsEmpty());
}

TEST_F(FilterLearningTest, ATruncatedStateFileIsReportedAndReplaced) {
    {
        FilterLearning learning(options);
        show(learning, 1, 1);
    }
    std::filesystem::resize_file(options.file, 1000);
    {
        FilterLearning learning(options);
        EXPECT_EQ(learning.counts().learner.stills, 0U);
        EXPECT_THAT(learning.takeWarnings(),
                    ElementsAre(HasSubstr("the checksum is wrong; learning starts again")));
        EXPECT_THAT(learning.takeWarnings(), IsEmpty());
        show(learning, 1, 1);
    }
    FilterLearning learning(options);
    EXPECT_EQ(learning.counts().learner.stills, 1U);
    EXPECT_THAT(learning.takeWarnings(), IsEmpty());
}

TEST_F(FilterLearningTest, FiltersLearnedFromOtherSensorsAreNotUsed) {
    {
        FilterLearning learning(options);
        show(learning, 1, 1);
    }
    options.sensors = "video, another still";
    FilterLearning learning(options);
    EXPECT_EQ(learning.counts().learner.stills, 0U);
    EXPECT_THAT(learning.takeWarnings(), ElementsAre(HasSubstr("another pair of sensors")));
}

TEST_F(FilterLearningTest, AResetForgetsTheFiltersAndDeletesTheStateFile) {
    {
        FilterLearning learning(options);
        show(learning, 1, 2);
    }
    {
        FilterLearning learning(options);
        (void)learning.takeFilters();
        learning.reset();
        ASSERT_TRUE(learning.finish(std::chrono::minutes(5)));
        EXPECT_EQ(learning.counts().learner.stills, 0U);
        EXPECT_NE(learning.takeFilters(), nullptr);
        EXPECT_FALSE(std::filesystem::exists(options.file));
    }
    EXPECT_FALSE(std::filesystem::exists(options.file));
}

TEST_F(FilterLearningTest, StillsThatArriveTooSoonAreSkipped) {
    options.waits = false;
    FilterLearning learning(options);
    const twin::Grey first = sharpDiscs(1), second = sharpDiscs(2);
    showTo(learning, first, first, {});
    const auto begun = std::chrono::steady_clock::now();
    for (int i = 0; i < 60'000 && learning.counts().learner.stills == 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto learned = std::chrono::steady_clock::now();
    ASSERT_EQ(learning.counts().learner.stills, 1U);
    // The thread has learned. It now skips stills for nine times as long as the learning took.
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    showTo(learning, second, second, {});
    if (std::chrono::steady_clock::now() - learned > 4 * (learned - begun))
        GTEST_SKIP() << "this machine is too busy: the second still came late";
    EXPECT_EQ(learning.counts().leftOut, 1U);
}

TEST_F(FilterLearningTest, LearningThatTakesTooLongIsReportedAsLate) {
    std::atomic<std::int64_t> passed{0};
    Heartbeats hearts([&] { return Timestamp::now() + std::chrono::seconds(passed); });
    options.watched = {&hearts, "learning", std::chrono::seconds(60), ThreadRole::Helper};
    FilterLearning learning(options);
    std::atomic<bool> isLate{false};
    {
        const std::jthread clock([&](const std::stop_token& stop) {
            while (!stop.stop_requested()) {
                passed = passed.load() + 61;
                if (!hearts.late().empty()) isLate = true;
            }
        });
        for (unsigned i = 1; i <= 20 && !isLate; ++i)
            show(learning, i, i);
    }
    EXPECT_TRUE(isLate);
    for (int i = 0; i < 10'000 && !hearts.late().empty(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(hearts.late().empty()) << "a thread that waits for a still is not late";
}

TEST(LearnedFiltersFile, EachPairOfSensorsHasItsFileInTheStateFolder) {
    unsetenv("STATE_DIRECTORY");
    EXPECT_TRUE(learnedFiltersFile("a").empty());
    setenv("STATE_DIRECTORY", "/some/folder", 1);
    EXPECT_EQ(learnedFiltersFile("a").parent_path(), "/some/folder");
    EXPECT_NE(learnedFiltersFile("a"), learnedFiltersFile("b"));
    EXPECT_EQ(learnedFiltersFile("a"), learnedFiltersFile("a"));
    unsetenv("STATE_DIRECTORY");
}

TEST(LearnedFilters, FiltersAreDescribedInOneLine) {
    LearningCounts counts;
    counts.learner = {12, 0, 0, 71, 1.02, 0.54};
    EXPECT_EQ(describe(counts),
              "12 stills; learned filters for 71 of 104 classes of pixels; gain over bicubic "
              "enlargement: 1.02 dB, with the shipped filters 0.54 dB");
}

}  // namespace
}  // namespace mfar
