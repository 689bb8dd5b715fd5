#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mfar::stress {

/// Errors of one quantity, printed as a line of a table.
class ErrorTable {
public:
    /// `what`: pass and quantity; `unit`: of the errors. Values below `least`, such as pixels near
    /// 0, use the unit in the last place of `least`.
    ErrorTable(std::string what, std::string unit, double least = 0)
        : what_(std::move(what)), unit_(std::move(unit)), least_(least) {}

    /// `error`: in the unit; `got` and `wanted`: for the error in units in the last place of single
    /// precision.
    void add(double error, double got, double wanted);
    void add(double error) { errors_.push_back(error); }

    [[nodiscard]] double worst() const;
    /// "what  count  p99.9  max  unit  max ulps"
    void print();
    static void printHead();

private:
    std::string what_, unit_;
    std::vector<double> errors_;
    double least_, ulps_ = -1;
};

}  // namespace mfar::stress
