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
    /// File that stores the learned state. Empty: the state is lost with this object.
    std::filesystem::path file;
    std::string sensors;  ///< names and picture sizes of the sensors, which filters depend on
    /// True: learn from every still. finish() waits until this is done, so that the same pictures
    /// give the same filters. False: learn with low priority, and skip stills that come while
    /// learning runs, or so early that learning would use more than a tenth of a CPU.
    bool waits = false;
    /// If the rig is set, guidance is learned, too, see enlarge::GuidanceLearner.
    std::optional<StereoRig> rig = std::nullopt;
    WatchedThread watched{};  ///< the learning thread; its time budget is for one still
};

/// Learns the enlarger's filters from matched stills, in a thread of its own. This thread stores
/// the learned state every minute and at the end. The picture thread copies the stills for it, one
/// still at a time.
class FilterLearning final : public MatchListener {
public:
    /// Reads the learned state from the file. If that fails, warns and learns from the beginning.
    explicit FilterLearning(FilterLearningOptions options);
    FilterLearning(const FilterLearning&) = delete;
    FilterLearning& operator=(const FilterLearning&) = delete;
    /// Calls stop().
    ~FilterLearning() override;

    /// Cancels learning from the current still and stores the state. This may wait for the disk.
    void stop();

    // The picture thread calls the following functions. Only finish() waits for the learning
    // thread.
    void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                 Rows<const LookUpCell> lookUps,
                 const MatchedPictures::LookedUp& lookedUp) override;
    void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                  Rows<const LookUpCell> lookUps,
                  const MatchedPictures::LookedUp& lookedUp) override;
    /// Returns the current filters if they have changed since the last call, otherwise null.
    [[nodiscard]] std::shared_ptr<const FilterBank> takeFilters();
    /// Waits until learning from the last still has ended, if FilterLearningOptions::waits is set.
    void finish();

    // The following functions are thread-safe.
    /// Deletes all that was learned, and the file.
    void reset();
    [[nodiscard]] LearningCounts counts() const;
    /// Returns the errors of reading and writing the file since the last call.
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
    EnlargerLearner learner_;  // only thread_, constructor and stop() use this
    // The new still, and the still before it with the last frame that was drawn with that still.
    // The picture thread owns them; while isFull_ is set, thread_ owns them.
    MatchedPictures pictures_, older_;
    std::optional<RgbPlanes> olderVideo_;
    bool hasOlder_ = false;    // whether `older_` is the still before the one in `pictures_`
    bool olderTaken_ = false;  // picture thread only: whether `older_` was set since the last still
    MatchedPictures truth_;    // only thread_ uses truth_ and matcher_
    std::unique_ptr<FrameMatcher> matcher_;  // created when it is first needed

    mutable std::mutex mutex_;
    std::condition_variable_any begun_;
    std::condition_variable done_;
    bool isFull_ = false, isNew_ = true, resets_ = false;
    std::shared_ptr<const FilterBank> filters_;
    LearningCounts counts_;
    std::vector<std::string> warnings_;
    Clock::time_point mayLearn_{};
    Clock::time_point stored_ = Clock::now();
    bool isStored_ = true;  // whether `file` is up to date; only thread_ and stop() use this

    std::jthread thread_;  // last member: it uses the members above
};

/// Returns the path of the file for the learned filters of these sensors, in the service's state
/// folder ($STATE_DIRECTORY). Returns an empty path if there is no such folder.
[[nodiscard]] std::filesystem::path learnedFiltersFile(const std::string& sensors);

}  // namespace mfar
