#pragma once

#include <map>
#include <string>
#include <vector>

namespace mfar::stress {

/// What the cases of a run found, and how much went through each pass.
class Checks {
public:
    /// Records `what` of a case when it does not hold. The first few of a case are kept.
    void require(bool holds, const std::string& what) {
        if (!holds) fail(what);
    }
    /// NaN is never within.
    void within(double value, double low, double high, const char* what) {
        if (!(value >= low && value <= high)) failRange(value, low, high, what);
    }
    void fail(const std::string& what);

    /// So many pixels of a picture went through a pass.
    void through(const std::string& pass, long pixels) { pixels_[pass] += pixels; }
    /// What is no pass over a picture had so many tags, matches or points.
    void tried(const std::string& part, long inputs) { inputs_[part] += inputs; }

    /// Pixels by pass.
    [[nodiscard]] const std::map<std::string, long>& pixels() const { return pixels_; }
    /// Inputs of the parts that have no pixels.
    [[nodiscard]] const std::map<std::string, long>& inputs() const { return inputs_; }
    /// What failed since the last call.
    [[nodiscard]] std::vector<std::string> take();

private:
    void failRange(double value, double low, double high, const char* what);

    std::map<std::string, long> pixels_, inputs_;
    std::vector<std::string> faults_;
};

}  // namespace mfar::stress
