#pragma once

#include "base/geometry.h"
#include "base/heartbeats.h"
#include "daemon/learning_counts.h"
#include "pipeline/enlarge/enlarger_learner.h"
#include "pipeline/enlarge/match_listener.h"
#include "pipeline/frame_matcher.h"
#include "pipeline/plan/rgb_planes.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace mfar {

struct FilterLearningOptions {
    /// Keeps what was learned; empty: it lasts as long as this.
    std::filesystem::path file;
    std::string sensors;  ///< both sensors' names and sizes: what is learned belongs to them
    /// Every still is learned from, and finish() waits for it: the same pictures give the same
    /// filters. Else stills that come while one is learned from, or so soon that learning would
    /// take more than a tenth of a processor, are left out.
    bool waits = false;
    /// Where it is known, guidance is learned, too: see enlarge::GuidanceLearner.
    std::optional<StereoRig> rig = std::nullopt;
    WatchedThread watched{};  ///< its budget is for one still
};

/// Learns the enlarger's filters from matched stills, in a thread of low priority that stores the
/// state every minute and at the end. Stills are copied on the frame's thread, one at a time.
class FilterLearning final : public MatchListener {
public:
    /// Goes on from the file where that can be read; see takeWarnings().
    explicit FilterLearning(FilterLearningOptions options);
    FilterLearning(const FilterLearning&) = delete;
    FilterLearning& operator=(const FilterLearning&) = delete;
    /// Like stop(), but faults are lost.
    ~FilterLearning() override;

    /// Gives up what is being learned from, and stores the state, which may wait for the disk.
    void stop();

    // For the frame's thread; none but finish() waits for the learning.
    void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                 Rows<const LookUpCell> lookUps,
                 const MatchedPictures::LookedUp& lookedUp) override;
    void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                  Rows<const LookUpCell> lookUps,
                  const MatchedPictures::LookedUp& lookedUp) override;
    /// The filters in place, where they are others than at the last call.
    [[nodiscard]] std::shared_ptr<const FilterBank> takeFilters();
    /// With FilterLearningOptions::waits: until the last still is learned from.
    void finish();

    // For any thread.
    /// Forgets everything, the file too.
    void reset();
    [[nodiscard]] LearningCounts counts() const;
    /// Faults of the file since the last call.
    [[nodiscard]] std::vector<std::string> takeWarnings();

private:
    using Clock = std::chrono::steady_clock;

    void restore();
    void run(const std::stop_token& stop);
    void learn(const std::stop_token& stop);
    [[nodiscard]] bool mayTake() const;
    [[nodiscard]] bool learnGuidance(const std::stop_token& stop);
    void forget();
    void store(const std::vector<std::uint8_t>& bytes);

    const FilterLearningOptions options_;
    EnlargerLearner learner_;  // of the thread; of the constructor and destructor
    // The new still, and the one before with the last frame that was drawn with it. They belong to
    // the frame's thread, and to the learner's while isFull_ is set.
    MatchedPictures pictures_, older_;
    std::optional<RgbPlanes> olderVideo_;
    bool hasOlder_ = false;                  // `older_` is of the still before that of `pictures_`
    bool olderTaken_ = false;                // of the frame's thread: since the last still
    MatchedPictures truth_;                  // of the other thread, as the next
    std::unique_ptr<FrameMatcher> matcher_;  // since it is needed for the first time

    mutable std::mutex mutex_;
    std::condition_variable_any begun_;
    std::condition_variable done_;
    bool isFull_ = false, isNew_ = true, resets_ = false;
    std::shared_ptr<const FilterBank> filters_;
    LearningCounts counts_;
    std::vector<std::string> warnings_;
    Clock::time_point mayLearn_{};
    Clock::time_point stored_ = Clock::now();
    bool isStored_ = true;  // of the thread

    std::jthread thread_;  // last: it uses all of the above
};

/// Where learned filters of these sensors are kept: in the service's state folder
/// ($STATE_DIRECTORY); empty where there is none.
[[nodiscard]] std::filesystem::path learnedFiltersFile(const std::string& sensors);

}  // namespace mfar
