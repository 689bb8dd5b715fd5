#pragma once

#include "pipeline/pipeline.h"
#include "tests/measure/bench/clock.h"
#include "tests/measure/bench/pareto.h"
#include "tests/measure/bench/summary.h"
#include "tests/measure/eval/shot.h"
#include "tests/measure/eval/stage_share.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mfar::bench {

using eval::shareOfStages;

class WayTimes {
public:
    void time(double ms) { ms_.push_back(ms); }
    void error(double value) {
        sum_ += value;
        ++count_;
    }
    void endSample() { medians_.push_back(summarise(std::exchange(ms_, {})).median); }
    [[nodiscard]] double ms() const {
        double sum = 0;
        for (const double ms : medians_)
            sum += ms / static_cast<double>(medians_.size());
        return sum;
    }
    [[nodiscard]] double meanError() const { return sum_ / count_; }

private:
    std::vector<double> ms_, medians_;
    double sum_ = 0;
    int count_ = 0;
};

/// Points of a stage. `ours`: names of mfar's settings, the default first. `times`: one entry for
/// each setting of `ours`, followed by one for each peer.
[[nodiscard]] inline std::vector<ParetoPoint> pointsOf(const std::vector<std::string>& ours,
                                                       const std::vector<std::string>& peers,
                                                       const std::vector<WayTimes>& times) {
    using Kind = ParetoPoint::Kind;
    std::vector<ParetoPoint> out;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const bool isPeer = i >= ours.size();
        const Kind kind = i == 0 ? Kind::Default : Kind::Ours;
        out.push_back({isPeer ? peers[i - ours.size()] : ours[i], isPeer ? Kind::Peer : kind,
                       times[i].ms(), times[i].meanError()});
    }
    return out;
}

template <class Method>
[[nodiscard]] auto timed(Method& method, const eval::Shot& frame, Clock clock) {
    eval::methodClock = clock;
    return method.run(frame);
}

/// Pipelines for one rig. Settings that can change between frames share a pipeline.
class PipelinePool {
public:
    explicit PipelinePool(const StereoRig& rig) : rig_(rig) {}

    /// Returns a pipeline that uses `options` from its next run on. Between calls, only two groups
    /// of options may differ: those in Quality, and those that the variable `fits` compares.
    Pipeline& with(const PipelineOptions& options) {
        for (auto& [made, pipeline] : made_) {
            const bool fits = made.flow2d.levels == options.flow2d.levels &&
                              made.epipolar.levels == options.epipolar.levels &&
                              made.epipolar.longestParallax == options.epipolar.longestParallax &&
                              made.depth.search == options.depth.search;
            if (!fits) continue;
            pipeline->setQuality({.mode = options.mode,
                                  .alongLines = true,
                                  .flow2d = options.flow2d,
                                  .epipolar = options.epipolar,
                                  .depthEvery = 1});
            return *pipeline;
        }
        made_.emplace_back(options, std::make_unique<Pipeline>(rig_, options));
        return *made_.back().second;
    }

private:
    StereoRig rig_;
    std::vector<std::pair<PipelineOptions, std::unique_ptr<Pipeline>>> made_;
};

}  // namespace mfar::bench
