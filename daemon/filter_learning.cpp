#include "daemon/filter_learning.h"

#include "base/bounded_file.h"
#include "base/thread_priority.h"
#include "base/whole_file.h"
#include "pipeline/enlarge/stored_numbers.h"

#include <fmt/format.h>

#include <system_error>

#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

constexpr double kShare = 0.1;
constexpr std::chrono::minutes kStoreEvery{1};
// Size limit of the file. The learned state has 1.2 MB, so a larger file was not written by mfard.
constexpr std::size_t kMostFilterBytes = 4 << 20;

std::vector<std::uint8_t> bytesOf(const std::filesystem::path& file) {
    try {
        return boundedFile(file, kMostFilterBytes);
    } catch (const std::runtime_error& error) {
        throw FilterBankError(fmt::format("{}: {}", file.string(), error.what()));
    }
}

}  // namespace

std::filesystem::path learnedFiltersFile(const std::string& sensors) {
    const char* folder = std::getenv("STATE_DIRECTORY");
    if (folder == nullptr || *folder == '\0') return {};
    const std::vector<std::uint8_t> bytes(sensors.begin(), sensors.end());
    return std::filesystem::path(folder) /
           fmt::format("filters-{:08x}.learned", enlarge::fnv1a(bytes));
}

std::string describe(const LearningCounts& counts) {
    const EnlargerLearner::Counts& of = counts.learner;
    std::string out =
        fmt::format("{} stills; learned filters for {} of {} classes of pixels; gain over bicubic "
                    "enlargement: {:.2f} dB, with the shipped filters {:.2f} dB",
                    of.stills, of.classes, enlarge::kUnique, of.gainDb, of.priorDb);
    if (of.guidance.any())
        out +=
            fmt::format("; guidance adds {:.2f} of the still's finest detail and removes {:.2f} "
                        "of the video's; light factor {:.2f}; gain over no guidance: {:.2f} dB",
                        of.guidance.still, of.guidance.video, of.guidance.light, of.guidanceGainDb);
    return out;
}

FilterLearning::FilterLearning(FilterLearningOptions options) : options_(std::move(options)) {
    restore();
    filters_ = learner_.filters();
    counts_.learner = learner_.counts();
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

FilterLearning::~FilterLearning() {
    stop();
}

void FilterLearning::stop() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
    if (resets_) forget();
    if (!isStored_) isStored_ = store(learner_.stored(options_.sensors));
}

void FilterLearning::restore() {
    std::error_code error;
    if (options_.file.empty() || !std::filesystem::exists(options_.file, error)) return;
    const std::string name = options_.file.string();
    try {
        learner_ = EnlargerLearner::restored(bytesOf(options_.file), options_.sensors, name);
    } catch (const FilterBankError& fault) {
        warnings_.push_back(std::string(fault.what()) + "; learning starts again");
    }
}

void FilterLearning::matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                             Rows<const LookUpCell> lookUps,
                             const MatchedPictures::LookedUp& lookedUp) {
    const bool hasOlder = std::exchange(olderTaken_, false);
    if (!mayTake()) {
        const std::lock_guard lock(mutex_);
        ++counts_.leftOut;
        return;
    }
    pictures_.take(video, still, lookUps, lookedUp);
    hasOlder_ = hasOlder;
    {
        const std::lock_guard lock(mutex_);
        isFull_ = true;
    }
    begun_.notify_one();
}

bool FilterLearning::mayTake() const {
    const std::lock_guard lock(mutex_);
    return !isFull_ && (options_.waits || Clock::now() >= mayLearn_);
}

void FilterLearning::replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                              Rows<const LookUpCell> lookUps,
                              const MatchedPictures::LookedUp& lookedUp) {
    olderTaken_ = options_.rig.has_value() && mayTake();
    if (!olderTaken_) return;
    older_.take(video, still, lookUps, lookedUp);
    olderVideo_ = video;
}

std::shared_ptr<const FilterBank> FilterLearning::takeFilters() {
    const std::lock_guard lock(mutex_);
    return std::exchange(isNew_, false) ? filters_ : nullptr;
}

bool FilterLearning::finish(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    return !options_.waits ||
           done_.wait_for(lock, longest, [this] { return !isFull_ && !resets_; });
}

void FilterLearning::reset() {
    {
        const std::lock_guard lock(mutex_);
        resets_ = true;
    }
    begun_.notify_one();
}

LearningCounts FilterLearning::counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
}

std::vector<std::string> FilterLearning::takeWarnings() {
    const std::lock_guard lock(mutex_);
    return std::exchange(warnings_, {});
}

void FilterLearning::run(const std::stop_token& stop) {
    // If the picture thread waits for this thread, a low priority would delay the frames.
    if (!options_.waits) lowerThreadPriority();
    Heartbeat heart(options_.watched);
    for (;;) {
        heart.rest();
        bool resets = false, learns = false;
        {
            std::unique_lock lock(mutex_);
            if (!begun_.wait(lock, stop, [this] { return isFull_ || resets_; })) return;
            resets = resets_;
            learns = isFull_;
        }
        heart.beat();
        if (resets) {
            forget();
        } else if (learns) {
            learn(stop);
        }
        {
            const std::lock_guard lock(mutex_);
            isNew_ = isNew_ || filters_ != learner_.filters();
            filters_ = learner_.filters();
            counts_.learner = learner_.counts();
            if (resets)
                resets_ = false;
            else
                isFull_ = false;
        }
        done_.notify_all();
    }
}

void FilterLearning::forget() {
    learner_ = EnlargerLearner();
    isStored_ = true;
    std::error_code ignored;
    if (!options_.file.empty()) std::filesystem::remove(options_.file, ignored);
}

void FilterLearning::learn(const std::stop_token& stop) {
    const double before = threadCpuMs();
    const EnlargerLearner::Outcome outcome = learner_.add(pictures_, stop);
    const bool hasLearned =
        outcome == EnlargerLearner::Outcome::Replaced || outcome == EnlargerLearner::Outcome::Kept;
    const bool hasGuidance = hasLearned && hasOlder_ && learnGuidance(stop);
    const double ms = threadCpuMs() - before;
    isStored_ = isStored_ && !hasLearned && !hasGuidance;
    const Clock::time_point now = Clock::now();
    if (!isStored_ && now - stored_ >= kStoreEvery && !stop.stop_requested()) {
        isStored_ = store(learner_.stored(options_.sensors));
        stored_ = now;
    }
    const std::lock_guard lock(mutex_);
    mayLearn_ = now + std::chrono::duration_cast<Clock::duration>(
                          std::chrono::duration<double, std::milli>(ms * (1 / kShare - 1)));
}

bool FilterLearning::learnGuidance(const std::stop_token& stop) {
    if (!matcher_) matcher_ = std::make_unique<FrameMatcher>(*options_.rig);
    const float light = learner_.filters()->guidance().light;
    matcher_->match(*olderVideo_, pictures_.still.rows(), light, truth_);
    const EnlargerLearner::Outcome outcome = learner_.addOlder(truth_, older_, stop);
    return outcome == EnlargerLearner::Outcome::Replaced ||
           outcome == EnlargerLearner::Outcome::Kept;
}

bool FilterLearning::store(const std::vector<std::uint8_t>& bytes) {
    if (options_.file.empty()) return true;
    try {
        writeWholeFile(options_.file, bytes);
        return true;
    } catch (const std::runtime_error& fault) {
        const std::lock_guard lock(mutex_);
        warnings_.push_back(std::string(fault.what()) + "; learned filters cannot be written");
        return false;
    }
}

}  // namespace mfar
