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
    double ms = 0;     ///< median run time [ms]
    double error = 0;  ///< as described by ParetoStage::measure; smaller is better
};

/// All methods for one stage. They were measured in turn in one run.
struct ParetoStage {
    std::string name;
    std::string measure;  ///< name of the error measure, with its unit
    std::string samples;  ///< names of the samples
    std::vector<ParetoPoint> points;
};

/// True if `a` is at least as fast and as accurate as `b` and better in one of the two. False if
/// any value is not finite.
[[nodiscard]] bool dominates(const ParetoPoint& a, const ParetoPoint& b);

/// Indices of the points that no other point dominates, by ascending time.
[[nodiscard]] std::vector<std::size_t> paretoFront(const std::vector<ParetoPoint>& points);

/// Names of the peers that dominate at least one of our points.
[[nodiscard]] std::vector<std::string> dominatingPeers(const ParetoStage& stage,
                                                       const ParetoPoint& point);

/// One line per point, with the columns stage,name,kind,ms,error,measure,front,dominated_by.
[[nodiscard]] std::string paretoCsv(const std::vector<ParetoStage>& stages);

/// A text for people: first our points that no peer dominates, then each of our other points with
/// the peers that dominate it, then the peers.
[[nodiscard]] std::string paretoSummary(const std::vector<ParetoStage>& stages);

/// One panel per stage with logarithmic axes: time on x, error on y. A line joins the points that
/// nothing dominates (the front). Discs are our points, diamonds are peers, and a ring marks the
/// default. The points of the front and the peers are labelled.
[[nodiscard]] std::string paretoSvg(const std::vector<ParetoStage>& stages);

}  // namespace mfar::bench
