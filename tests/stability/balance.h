#pragma once

#include "tests/stability/cases.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mfar::stress {

/// Chooses cases at the product's size so that all passes get about equal numbers of pixels. For
/// the pass with the fewest pixels, it chooses the case that has given it pixels fastest so far. If
/// only small pictures have reached a pass, the case that reached it is tried for a limited time.
class Balance {
public:
    explicit Balance(const std::vector<Case>& cases);

    /// Null if each pass has `enough` pixels, or if no case reaches the passes that need more.
    [[nodiscard]] const Case* next(const Checks& checks, long enough) const;
    /// Records a run of a case. `before`, `after`: pixels of all passes before and after it;
    /// `seconds`: its duration; `scale`: the size of its pictures.
    void ran(const Case& one, const std::map<std::string, long>& before,
             const std::map<std::string, long>& after, double seconds, Scale scale);

private:
    struct Known {
        Case one;
        double seconds = 0;
        std::map<std::string, long> pixels;  // pixels of each pass in all runs of the case
        std::set<std::string> passes;        // passes that it reached, at any size
    };
    [[nodiscard]] const Known* quickest(const std::string& pass) const;

    std::vector<Known> cases_;
};

}  // namespace mfar::stress
