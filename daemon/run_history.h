#pragma once

#include "base/time.h"
#include "pipeline/stage_clock.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// Distribution of times in one bin of a history. Two of them can be added. Memory grows with the
/// number of different times, not with their count. Buckets grow by 2^(1/8), so that a quantile is
/// at most 4.5 % off.
class TimeSpread {
public:
    /// Milliseconds; zero, negative and NaN count as 1 us, more than 10 minutes as 10 minutes.
    void add(double ms);
    void add(const TimeSpread& other);
    /// The value that a share q of all values does not exceed; NaN without values.
    [[nodiscard]] double quantile(double q) const;

private:
    std::map<std::int16_t, std::uint64_t> counts_;
};

/// Totals since the start.
struct RunTotals {
    std::uint64_t notTaken = 0;     ///< frames missed by the sensor or replaced by newer ones
    std::uint64_t notRecorded = 0;  ///< shown, but not recorded
    std::uint64_t notWritten = 0;   ///< finished, but not written by the display
    std::uint64_t stillsReceived = 0, stillsUsed = 0, stillsLost = 0;
    std::uint64_t posesAsked = 0, posesFound = 0;
    double learnedGainDb = 0;  ///< of learned filters over bicubic
};

/// One picture of the run.
struct RunMoment {
    Timestamp shown;
    double frameMs = 0, latencyMs = 0;
    bool isLate = false;
    std::optional<double> confidence{};  ///< set if a still was used
    RunTotals totals{};
};

/// The course of a run in at most kMostBins bins of equal length. If the run gets longer, every two
/// bins become one, so that memory stays bounded over months. One thread.
class RunHistory {
public:
    static constexpr std::size_t kMostBins = 512;

    struct Bin {
        TimeSpread frameMs, latencyMs;
        std::vector<TimeSpread> stageMs;  ///< indexed like stages(); may be shorter
        std::uint64_t frames = 0, late = 0;
        double confidenceSum = 0;
        std::uint64_t confidenceFrames = 0;
        RunTotals totals{};  ///< at the last picture; of a bin without pictures: zero
    };

    void add(const RunMoment& moment, const std::vector<StageTime>& stages);
    /// Makes bins longer until they have at least this many pictures on average.
    void fold(double picturesPerBin);

    [[nodiscard]] const std::vector<Bin>& bins() const { return bins_; }
    /// Length of a bin [s].
    [[nodiscard]] double binS() const { return binS_; }
    /// Names of stages in the order of their first use.
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

/// Small pictures for a report, as JPEG files; empty: none.
struct RunPictures {
    std::vector<std::uint8_t> frame;  ///< the last picture as it was shown
    std::vector<std::uint8_t> still;  ///< the last still that was used
};

}  // namespace mfar
