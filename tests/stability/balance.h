#pragma once

#include "tests/stability/cases.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mfar::stress {

/// Chooses cases at the product's size so that as many pixels go through each pass: the one that
/// brings the pass with the fewest on fastest, by what each case did before. A pass that has come
/// with small pictures alone is tried with the case that brought it, for some time.
class Balance {
public:
    explicit Balance(const std::vector<Case>& cases);

    /// Nothing when `enough` pixels went through each pass, or no case brings one on.
    [[nodiscard]] const Case* next(const Checks& checks, long enough) const;
    /// `before` and `after` it ran, that took so long; with pictures of which size.
    void ran(const Case& one, const std::map<std::string, long>& before,
             const std::map<std::string, long>& after, double seconds, Scale scale);

private:
    struct Known {
        Case one;
        double seconds = 0;
        std::map<std::string, long> pixels;  // of all its runs
        std::set<std::string> passes;        // at other sizes, too
    };
    [[nodiscard]] const Known* quickest(const std::string& pass) const;

    std::vector<Known> cases_;
};

}  // namespace mfar::stress
