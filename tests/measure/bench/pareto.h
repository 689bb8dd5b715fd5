#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mfar::bench {

/// One way to do the work of a stage: what it takes and how wrong it is.
struct ParetoPoint {
    enum class Kind { Ours, Default, Peer };

    std::string name;
    Kind kind = Kind::Ours;
    double ms = 0;     ///< median
    double error = 0;  ///< as ParetoStage::measure says; less is better
};

/// All ways of one stage, measured in turn in one run.
struct ParetoStage {
    std::string name;
    std::string measure;  ///< what the error is, with its unit
    std::string samples;  ///< what it was measured on
    std::vector<ParetoPoint> points;
};

/// Neither slower nor less accurate, and not the same in both. False for what is not finite.
[[nodiscard]] bool dominates(const ParetoPoint& a, const ParetoPoint& b);

/// Indices of the points that no other dominates, in rising order of time.
[[nodiscard]] std::vector<std::size_t> paretoFront(const std::vector<ParetoPoint>& points);

/// Names of the peers that dominate a point of ours.
[[nodiscard]] std::vector<std::string> dominatingPeers(const ParetoStage& stage,
                                                       const ParetoPoint& point);

/// stage,name,kind,ms,error,measure,front,dominated_by: a line a point.
[[nodiscard]] std::string paretoCsv(const std::vector<ParetoStage>& stages);

/// For people: the points of ours that no peer dominates, and those that one does, with its name.
[[nodiscard]] std::string paretoSummary(const std::vector<ParetoStage>& stages);

/// A panel a stage: time across, error upwards, both logarithmic; the front as a line, ours as
/// discs, peers as diamonds, the default ringed. Names stand at the front and the peers.
[[nodiscard]] std::string paretoSvg(const std::vector<ParetoStage>& stages);

}  // namespace mfar::bench
