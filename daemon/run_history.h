#pragma once

#include "base/time.h"
#include "pipeline/stage_clock.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// The distribution of times in one bin of a history. Only buckets with at least one time need
/// memory. Each bucket is 2^(1/8) times as wide as the one before it, so that the error of a
/// quantile is at most 4.5 %.
class TimeSpread {
public:
    /// Adds a time [ms]. Zero, negative numbers and NaN count as 1 us. Times of more than 10
    /// minutes count as 10 minutes.
    void add(double ms);
    void add(const TimeSpread& other);
    /// Returns the quantile q: the time [ms] that a share q of all times does not exceed. Returns
    /// NaN without times.
    [[nodiscard]] double quantile(double q) const;

private:
    std::map<std::int16_t, std::uint64_t> counts_;
};

struct RunTotals {
    std::uint64_t notTaken = 0;  ///< frames dropped before processing
    std::uint64_t notRecorded = 0;
    std::uint64_t notWritten = 0;
    std::uint64_t stillsReceived = 0, stillsUsed = 0, stillsLost = 0;
    std::uint64_t posesAsked = 0, posesFound = 0;
    double learnedGainDb = 0;
};

struct RunMoment {
    Timestamp shown;
    double frameMs = 0, latencyMs = 0;
    bool isLate = false;
    std::optional<double> confidence{};
    RunTotals totals{};
};

/// The history of a run, in at most kMostBins bins of equal duration. If a longer run needs more
/// bins, neighbouring bins are merged in pairs. So memory stays limited over months. Not
/// thread-safe.
class RunHistory {
public:
    static constexpr std::size_t kMostBins = 512;

    struct Bin {
        TimeSpread frameMs, latencyMs;
        std::vector<TimeSpread> stageMs;
        std::uint64_t frames = 0, late = 0;
        double confidenceSum = 0;
        std::uint64_t confidenceFrames = 0;
        RunTotals totals{};  ///< totals at the bin's last picture; zero if the bin has no picture
    };

    void add(const RunMoment& moment, const std::vector<StageTime>& stages);
    /// Merges neighbouring bins until they have at least this number of pictures on average.
    void fold(double picturesPerBin);

    [[nodiscard]] const std::vector<Bin>& bins() const { return bins_; }
    [[nodiscard]] double binS() const { return binS_; }
    [[nodiscard]] const std::vector<std::string>& stages() const { return stages_; }

private:
    static constexpr double kShortestBinS = 0.1;

    [[nodiscard]] Bin& binAt(Timestamp shown);
    [[nodiscard]] std::size_t indexOf(const char* stage);
    void fold();

    std::optional<Timestamp> first_;
    double binS_ = kShortestBinS;
    std::vector<Bin> bins_;
    std::vector<std::string> stages_;
};

/// Small pictures for a report, as JPEG files. An empty file means that there is no picture.
struct RunPictures {
    std::vector<std::uint8_t> frame;
    std::vector<std::uint8_t> still;
};

}  // namespace mfar
