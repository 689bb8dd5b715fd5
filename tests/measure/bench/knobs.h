#pragma once

#include "pipeline/pipeline.h"

#include <functional>
#include <string>
#include <vector>

namespace mfar::bench {

/// A flow option that trades time for accuracy, with the values to measure in ascending order.
struct Knob {
    std::string method;
    std::string name;  ///< member of Flow2dOptions or EpipolarOptions
    std::vector<double> values;
    std::function<double(const PipelineOptions&)> get;
    std::function<void(PipelineOptions&, double)> set;
};

[[nodiscard]] std::vector<Knob> flowKnobs();

}  // namespace mfar::bench
