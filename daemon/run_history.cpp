#include "daemon/run_history.h"

#include "daemon/histogram.h"

#include <algorithm>
#include <limits>

namespace mfar {
namespace {

constexpr double kMostMs = 6e5;
constexpr TimeBuckets kBuckets{8};

void merge(RunHistory::Bin& into, const RunHistory::Bin& later) {
    into.frameMs.add(later.frameMs);
    into.latencyMs.add(later.latencyMs);
    into.stageMs.resize(std::max(into.stageMs.size(), later.stageMs.size()));
    for (std::size_t i = 0; i < later.stageMs.size(); ++i)
        into.stageMs[i].add(later.stageMs[i]);
    into.frames += later.frames;
    into.late += later.late;
    into.confidenceSum += later.confidenceSum;
    into.confidenceFrames += later.confidenceFrames;
    if (later.frames > 0) into.totals = later.totals;
}

}  // namespace

void TimeSpread::add(double ms) {
    ++counts_[static_cast<std::int16_t>(kBuckets.of(std::min(ms, kMostMs)))];
}

void TimeSpread::add(const TimeSpread& other) {
    for (const auto& [bucket, count] : other.counts_)
        counts_[bucket] += count;
}

double TimeSpread::quantile(double q) const {
    double all = 0, seen = 0;
    for (const auto& [bucket, count] : counts_)
        all += static_cast<double>(count);
    for (const auto& [bucket, count] : counts_) {
        seen += static_cast<double>(count);
        if (seen >= q * all) return kBuckets.middleMs(bucket);
    }
    return std::numeric_limits<double>::quiet_NaN();
}

void RunHistory::add(const RunMoment& moment, const std::vector<StageTime>& stages) {
    Bin& bin = binAt(moment.shown);
    bin.frameMs.add(moment.frameMs);
    bin.latencyMs.add(moment.latencyMs);
    for (const StageTime& stage : stages) {
        const std::size_t index = indexOf(stage.stage);
        bin.stageMs.resize(std::max(bin.stageMs.size(), index + 1));
        bin.stageMs[index].add(stage.ms);
    }
    ++bin.frames;
    if (moment.isLate) ++bin.late;
    if (moment.confidence) {
        bin.confidenceSum += *moment.confidence;
        ++bin.confidenceFrames;
    }
    bin.totals = moment.totals;
}

// Returns the bin for this time. If it does not exist yet, adds it. If no pictures were shown for a
// while, also adds empty bins for that time; they are gaps in the charts.
RunHistory::Bin& RunHistory::binAt(Timestamp shown) {
    if (!first_) first_ = shown;
    const double seconds = std::max(secondsBetween(*first_, shown), 0.0);
    while (seconds / binS_ >= static_cast<double>(kMostBins))
        fold();
    const auto index = static_cast<std::size_t>(seconds / binS_);
    if (index >= bins_.size()) bins_.resize(index + 1);
    return bins_[index];
}

std::size_t RunHistory::indexOf(const char* stage) {
    const auto known = std::ranges::find(stages_, stage);
    const auto index = static_cast<std::size_t>(known - stages_.begin());
    if (known == stages_.end()) stages_.emplace_back(stage);
    return index;
}

void RunHistory::fold(double picturesPerBin) {
    double pictures = 0;
    for (const Bin& bin : bins_)
        pictures += static_cast<double>(bin.frames);
    while (bins_.size() > 1 && pictures < picturesPerBin * static_cast<double>(bins_.size()))
        fold();
}

void RunHistory::fold() {
    const std::size_t half = (bins_.size() + 1) / 2;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
        if (i % 2 == 0 && i > 0)
            bins_[i / 2] = std::move(bins_[i]);
        else if (i % 2 == 1)
            merge(bins_[i / 2], bins_[i]);
    }
    bins_.resize(half);
    binS_ *= 2;
}

}  // namespace mfar
