#pragma once

#include "tests/stability/cases.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mfar::stress {

/// Chooses cases at the product's size so that the passes get equal numbers of pixels: for the pass
/// with the fewest, the case that has yielded its pixels fastest so far. A pass that was only
/// reached with small pictures is tried for some time with the case that reached it.
class Balance {
public:
    explicit Balance(const std::vector<Case>& cases);

    /// Nothing when each pass got `enough` pixels, or no case reaches the missing ones.
    [[nodiscard]] const Case* next(const Checks& checks, long enough) const;
    /// Reports a run of a case: the pixels of all passes `before` and `after` it, its time, the
    /// size of its pictures.
    void ran(const Case& one, const std::map<std::string, long>& before,
             const std::map<std::string, long>& after, double seconds, Scale scale);

private:
    struct Known {
        Case one;
        double seconds = 0;
        std::map<std::string, long> pixels;  // of all its runs
        std::set<std::string> passes;        // reached, at any size
    };
    [[nodiscard]] const Known* quickest(const std::string& pass) const;

    std::vector<Known> cases_;
};

}  // namespace mfar::stress
