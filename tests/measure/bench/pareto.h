#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mfar::bench {

struct ParetoPoint {
    enum class Kind { Ours, Default, Peer };

    std::string name;
    Kind kind = Kind::Ours;
    double ms = 0;     ///< median run time, mean over the samples
    double error = 0;  ///< in the unit of ParetoStage::measure; smaller is better
};

/// All methods for one stage, measured in the same run.
struct ParetoStage {
    std::string name;
    std::string measure;
    std::string samples;
    std::vector<ParetoPoint> points;
};

/// True if `a` is at least as fast and as accurate as `b` and better in one of the two. False if
/// any value is not finite.
[[nodiscard]] bool dominates(const ParetoPoint& a, const ParetoPoint& b);

/// Indices of the points that no other point dominates, by ascending time.
[[nodiscard]] std::vector<std::size_t> paretoFront(const std::vector<ParetoPoint>& points);

[[nodiscard]] std::vector<std::string> dominatingPeers(const ParetoStage& stage,
                                                       const ParetoPoint& point);

[[nodiscard]] std::string paretoCsv(const std::vector<ParetoStage>& stages);

/// Text with our points that no peer dominates, then our other points with the peers that dominate
/// them, then the peers.
[[nodiscard]] std::string paretoSummary(const std::vector<ParetoStage>& stages);

/// Chart with one panel per stage and logarithmic axes: time on x, error on y. A line joins the
/// points that no other dominates (the front). Discs are our points, diamonds are peers, and a ring
/// marks the default.
[[nodiscard]] std::string paretoSvg(const std::vector<ParetoStage>& stages);

}  // namespace mfar::bench
