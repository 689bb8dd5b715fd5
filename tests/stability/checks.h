#pragma once

#include <map>
#include <string>
#include <vector>

namespace mfar::stress {

/// The faults that the cases of a run found, and the amount of data of each pass.
class Checks {
public:
    /// Records `what` as a fault when it does not hold. Only the first few faults of a case are
    /// kept.
    void require(bool holds, const std::string& what) {
        if (!holds) fail(what);
    }
    /// NaN is never within a range.
    void within(double value, double low, double high, const char* what) {
        if (!(value >= low && value <= high)) failRange(value, low, high, what);
    }
    void fail(const std::string& what);

    /// Adds pixels of a picture that a pass processed.
    void through(const std::string& pass, long pixels) { pixels_[pass] += pixels; }
    /// Adds inputs (tags, matches, points) of a part that does not process pictures.
    void tried(const std::string& part, long inputs) { inputs_[part] += inputs; }

    /// Pixels by pass.
    [[nodiscard]] const std::map<std::string, long>& pixels() const { return pixels_; }
    /// Inputs of the parts that do not process pictures.
    [[nodiscard]] const std::map<std::string, long>& inputs() const { return inputs_; }
    /// The faults since the last call.
    [[nodiscard]] std::vector<std::string> take();

private:
    void failRange(double value, double low, double high, const char* what);

    std::map<std::string, long> pixels_, inputs_;
    std::vector<std::string> faults_;
};

}  // namespace mfar::stress
