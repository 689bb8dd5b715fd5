#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mfar::stress {

/// Collects the errors of one quantity and prints them as one line of a table.
class ErrorTable {
public:
    /// `what`: the pass and the quantity. `unit`: unit of the errors. `least` counts only for
    /// errors in units in the last place (ulps): for wanted values below it, such as pixels near 0,
    /// the ulp of `least` is used.
    ErrorTable(std::string what, std::string unit, double least = 0)
        : what_(std::move(what)), unit_(std::move(unit)), least_(least) {}

    /// `error`: in the table's unit. The table also counts the difference of `got` and `wanted` in
    /// units in the last place (ulps) of single precision.
    void add(double error, double got, double wanted);
    void add(double error) { errors_.push_back(error); }

    [[nodiscard]] double worst() const;
    /// Prints "what  count  p99.9  max  unit  max ulps".
    void print();
    static void printHead();

private:
    std::string what_, unit_;
    std::vector<double> errors_;
    double least_, ulps_ = -1;
};

}  // namespace mfar::stress
