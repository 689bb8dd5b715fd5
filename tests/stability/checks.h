#pragma once

#include <map>
#include <string>
#include <vector>

namespace mfar::stress {

/// The faults that the cases found, and the amount of data that each pass processed.
class Checks {
public:
    /// Records the fault `what` if `holds` is false. Keeps only the first few faults of a case.
    void require(bool holds, const std::string& what) {
        if (!holds) fail(what);
    }
    /// Records the fault "`what` is `value`, not in ..." if the value is outside [low, high] or
    /// NaN.
    void within(double value, double low, double high, const char* what) {
        if (!(value >= low && value <= high)) failRange(value, low, high, what);
    }
    void fail(const std::string& what);

    void through(const std::string& pass, long pixels) { pixels_[pass] += pixels; }
    /// Counts `inputs` (tags, matches or points) of a part that does not process pictures.
    void tried(const std::string& part, long inputs) { inputs_[part] += inputs; }

    [[nodiscard]] const std::map<std::string, long>& pixels() const { return pixels_; }
    [[nodiscard]] const std::map<std::string, long>& inputs() const { return inputs_; }
    [[nodiscard]] std::vector<std::string> take();

private:
    void failRange(double value, double low, double high, const char* what);

    std::map<std::string, long> pixels_, inputs_;
    std::vector<std::string> faults_;
};

}  // namespace mfar::stress
