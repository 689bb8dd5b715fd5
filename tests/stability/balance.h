#pragma once

#include "tests/stability/cases.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mfar::stress {

/// Chooses the cases to run with pictures of the product's size, so that all passes process about
/// equal numbers of pixels. For the pass with the fewest pixels, it chooses the case that has made
/// this pass process most pixels per second so far. If only runs with small pictures have reached a
/// pass, the case that reached it is tried for a limited time.
class Balance {
public:
    explicit Balance(const std::vector<Case>& cases);

    /// The case to run next. Null if each pass has processed `enough` pixels, or if no case reaches
    /// the passes that need more.
    [[nodiscard]] const Case* next(const Checks& checks, long enough) const;
    /// Records a run of a case. `before`, `after`: pixels that each pass had processed before and
    /// after the run; `seconds`: duration of the run; `scale`: size of the run's pictures.
    void ran(const Case& one, const std::map<std::string, long>& before,
             const std::map<std::string, long>& after, double seconds, Scale scale);

private:
    struct Known {
        Case one;
        double seconds = 0;
        std::map<std::string, long>
            pixels;                    // pixels that each pass processed in all runs of the case
        std::set<std::string> passes;  // passes that the case reached with any size of pictures
    };
    [[nodiscard]] const Known* quickest(const std::string& pass) const;

    std::vector<Known> cases_;
};

}  // namespace mfar::stress
