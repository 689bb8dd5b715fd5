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
    /// File of the learned state; empty: the state is lost with this object.
    std::filesystem::path file;
    std::string sensors;  ///< both sensors' names and sizes, for which filters are learned
    /// Learn from every still; finish() waits until it is done, so that the same pictures give the
    /// same filters. Otherwise stills are skipped that come during learning, or so early that
    /// learning would use more than a tenth of a processor.
    bool waits = false;
    /// Where this is set, guidance is learned, too: see enlarge::GuidanceLearner.
    std::optional<StereoRig> rig = std::nullopt;
    WatchedThread watched{};  ///< its time budget is for one still
};

/// Learns the enlarger's filters from matched stills, in a low-priority thread that stores the
/// state every minute and at the end. Stills are copied on the frame's thread, one at a time.
class FilterLearning final : public MatchListener {
public:
    /// Loads the state from the file where that can be read; see takeWarnings().
    explicit FilterLearning(FilterLearningOptions options);
    FilterLearning(const FilterLearning&) = delete;
    FilterLearning& operator=(const FilterLearning&) = delete;
    /// Like stop(), but errors are ignored.
    ~FilterLearning() override;

    /// Aborts learning from the current still, and stores the state, which may wait for the disk.
    void stop();

    // For the frame's thread; only finish() waits for the learning.
    void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                 Rows<const LookUpCell> lookUps,
                 const MatchedPictures::LookedUp& lookedUp) override;
    void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                  Rows<const LookUpCell> lookUps,
                  const MatchedPictures::LookedUp& lookedUp) override;
    /// The current filters, if they have changed since the last call.
    [[nodiscard]] std::shared_ptr<const FilterBank> takeFilters();
    /// With FilterLearningOptions::waits: waits until the last still has been learned from.
    void finish();

    // For any thread.
    /// Forgets everything, the file too.
    void reset();
    [[nodiscard]] LearningCounts counts() const;
    /// Errors of the file since the last call.
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
    EnlargerLearner learner_;  // used by thread_, and by constructor and destructor
    // The new still, and the previous one with the last frame that was drawn with it. They belong
    // to the frame's thread, and to the learner's thread while isFull_ is set.
    MatchedPictures pictures_, older_;
    std::optional<RgbPlanes> olderVideo_;
    bool hasOlder_ = false;    // `older_` holds the still before the one in `pictures_`
    bool olderTaken_ = false;  // used by the frame's thread: `older_` was set since the last still
    MatchedPictures truth_;    // used by thread_, as is matcher_
    std::unique_ptr<FrameMatcher> matcher_;  // created at first use

    mutable std::mutex mutex_;
    std::condition_variable_any begun_;
    std::condition_variable done_;
    bool isFull_ = false, isNew_ = true, resets_ = false;
    std::shared_ptr<const FilterBank> filters_;
    LearningCounts counts_;
    std::vector<std::string> warnings_;
    Clock::time_point mayLearn_{};
    Clock::time_point stored_ = Clock::now();
    bool isStored_ = true;  // used by thread_

    std::jthread thread_;  // last: it uses all of the above
};

/// Where the learned filters of these sensors are stored: in the service's state folder
/// ($STATE_DIRECTORY); empty where there is none.
[[nodiscard]] std::filesystem::path learnedFiltersFile(const std::string& sensors);

}  // namespace mfar
