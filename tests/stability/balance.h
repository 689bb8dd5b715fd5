#pragma once

#include "tests/stability/cases.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mfar::stress {

/// Chooses cases to be run at Scale::Product, so that all passes process about equally many pixels.
/// next() first returns each case once. Later, it finds the pass with the fewest pixels and returns
/// the case that processes most pixels of this pass per second. If no case has reached the pass at
/// Scale::Product, next() returns a case that reached it with smaller pictures, until this case has
/// run for kTrial seconds.
class Balance {
public:
    explicit Balance(const std::vector<Case>& cases);

    /// The next case. Null if each pass has processed `enough` pixels, or if no case reaches the
    /// passes that need more.
    [[nodiscard]] const Case* next(const Checks& checks, long enough) const;
    /// Records a run of a case. `before`, `after`: pixels of each pass before and after the run.
    /// `seconds`: duration. `scale`: size of the run's pictures.
    void ran(const Case& one, const std::map<std::string, long>& before,
             const std::map<std::string, long>& after, double seconds, Scale scale);

private:
    struct Known {
        Case one;
        double seconds = 0;
        std::map<std::string, long> pixels;
        std::set<std::string> passes;  // passes that the case reached with pictures of any size
    };
    [[nodiscard]] const Known* quickest(const std::string& pass) const;

    std::vector<Known> cases_;
};

}  // namespace mfar::stress
