#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mfar::bench {

/// One method for a stage: its time and its error.
struct ParetoPoint {
    enum class Kind { Ours, Default, Peer };

    std::string name;
    Kind kind = Kind::Ours;
    double ms = 0;     ///< median
    double error = 0;  ///< see ParetoStage::measure; smaller is better
};

/// All methods for one stage, measured in turn in one run.
struct ParetoStage {
    std::string name;
    std::string measure;  ///< definition of the error, with its unit
    std::string samples;  ///< the samples used
    std::vector<ParetoPoint> points;
};

/// Whether `a` is neither slower nor less accurate than `b` and differs from it. False for values
/// that are not finite.
[[nodiscard]] bool dominates(const ParetoPoint& a, const ParetoPoint& b);

/// Indices of the points that no other point dominates, by ascending time.
[[nodiscard]] std::vector<std::size_t> paretoFront(const std::vector<ParetoPoint>& points);

/// Names of the peers that dominate a point of ours.
[[nodiscard]] std::vector<std::string> dominatingPeers(const ParetoStage& stage,
                                                       const ParetoPoint& point);

/// stage,name,kind,ms,error,measure,front,dominated_by: one line per point.
[[nodiscard]] std::string paretoCsv(const std::vector<ParetoStage>& stages);

/// Human-readable: our points that no peer dominates, and those that a peer dominates, with its
/// name.
[[nodiscard]] std::string paretoSummary(const std::vector<ParetoStage>& stages);

/// One panel per stage: time on x, error on y, both logarithmic; the front as a line, our points as
/// discs, peers as diamonds, the default ringed. The front and the peers are labelled.
[[nodiscard]] std::string paretoSvg(const std::vector<ParetoStage>& stages);

}  // namespace mfar::bench
