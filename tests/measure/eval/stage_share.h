#pragma once

#include "pipeline/pipeline.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace mfar::eval {

/// The stages that compute the flow, with or without poses.
inline constexpr std::array<std::string_view, 3> kFlowStages{"pyramid", "epipolar", "flow"};
inline constexpr std::array<std::string_view, 4> kDepthStages{"pyramid", "epipolar", "flow",
                                                              "depth"};

/// Returns the time of the named stages in the last run [ms]. Needs Pipeline::setMeasure(true).
[[nodiscard]] inline double msOfStages(const Pipeline& pipeline,
                                       std::span<const std::string_view> names) {
    double out = 0;
    for (const StageTime& stage : pipeline.stageTimes())
        if (std::ranges::find(names, std::string_view(stage.stage)) != names.end()) out += stage.ms;
    return out;
}

/// Returns the share (0 to 1) of the last run's time that the named stages took. Needs
/// Pipeline::setMeasure(true).
[[nodiscard]] inline double shareOfStages(const Pipeline& pipeline,
                                          std::span<const std::string_view> names) {
    double all = 0;
    for (const StageTime& stage : pipeline.stageTimes())
        all += stage.ms;
    return all > 0 ? msOfStages(pipeline, names) / all : 0;
}

}  // namespace mfar::eval
