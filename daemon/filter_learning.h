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
    std::filesystem::path file;
    /// Names and picture sizes of the sensors. Learned filters are valid for these sensors only.
    std::string sensors;
    /// True: learns from every still, and finish() waits for this. So the same pictures
    /// always give the same filters. False: the learning thread has a low priority. It skips stills
    /// that arrive while it works, and stills for which it would need more than a tenth of a CPU.
    bool waits = false;
    /// If the rig is set, guidance is learned, too, see enlarge::GuidanceLearner.
    std::optional<StereoRig> rig = std::nullopt;
    WatchedThread watched{};  ///< the learning thread, with the time budget for one still
};

/// Learns the enlarger's filters from matched stills, on a thread of its own. The picture thread
/// gives this learning thread a copy of one still at a time. The learning thread stores what it has
/// learned, at most once a minute. stop() stores the rest.
class FilterLearning final : public MatchListener {
public:
    /// Reads the learned state from the file, if the file exists. If that fails, queues a warning
    /// and learns from the beginning.
    explicit FilterLearning(FilterLearningOptions options);
    FilterLearning(const FilterLearning&) = delete;
    FilterLearning& operator=(const FilterLearning&) = delete;
    ~FilterLearning() override;

    /// Cancels learning from the current still and stores the state. This may wait for the disk.
    void stop();

    // The following functions are for the picture thread only. They do not wait for the learning
    // thread, except for finish().
    void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                 Rows<const LookUpCell> lookUps,
                 const MatchedPictures::LookedUp& lookedUp) override;
    void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                  Rows<const LookUpCell> lookUps,
                  const MatchedPictures::LookedUp& lookedUp) override;
    [[nodiscard]] std::shared_ptr<const FilterBank> takeFilters();
    /// If FilterLearningOptions::waits is set, waits until learning from the last still has ended.
    /// Returns false after `longest`.
    [[nodiscard]] bool finish(std::chrono::milliseconds longest);

    // The following functions are thread-safe.
    /// Requests that the learning thread deletes all that was learned, and the file. Does not wait
    /// for this.
    void reset();
    [[nodiscard]] LearningCounts counts() const;
    [[nodiscard]] std::vector<std::string> takeWarnings();

private:
    using Clock = std::chrono::steady_clock;

    void restore();
    void run(const std::stop_token& stop);
    void learn(const std::stop_token& stop);
    [[nodiscard]] bool mayTake() const;
    [[nodiscard]] bool learnGuidance(const std::stop_token& stop);
    void forget();
    /// Returns false if the file cannot be written.
    [[nodiscard]] bool store(const std::vector<std::uint8_t>& bytes);

    const FilterLearningOptions options_;
    EnlargerLearner learner_;  // used by thread_, the constructor and stop() only
    // `pictures_` holds the new still. `older_` holds the still before it and the last frame that
    // was drawn with that older still. The picture thread owns both while isFull_ is false, and
    // thread_ owns both while isFull_ is true.
    MatchedPictures pictures_, older_;
    std::optional<RgbPlanes> olderVideo_;
    bool hasOlder_ = false;  // true: `older_` is the still before the one in `pictures_`
    // True: replaced() has set `older_` since the last matched(). Only the picture thread uses it.
    bool olderTaken_ = false;
    // The frame in `older_`, matched with the new still instead of the still in `older_`. Only
    // thread_ uses truth_ and matcher_.
    MatchedPictures truth_;
    std::unique_ptr<FrameMatcher> matcher_;

    mutable std::mutex mutex_;
    std::condition_variable_any begun_;
    std::condition_variable done_;
    bool isFull_ = false, isNew_ = true, resets_ = false;
    std::shared_ptr<const FilterBank> filters_;
    LearningCounts counts_;
    std::vector<std::string> warnings_;
    Clock::time_point mayLearn_{};
    Clock::time_point stored_ = Clock::now();
    bool isStored_ = true;  // true: the file is up to date; used by thread_ and stop() only

    std::jthread thread_;  // last member: it uses the members above
};

/// Returns the path of the file for the learned filters of these sensors. It is in the service's
/// state folder ($STATE_DIRECTORY). Returns an empty path if there is no such folder.
[[nodiscard]] std::filesystem::path learnedFiltersFile(const std::string& sensors);

}  // namespace mfar
