#pragma once

#include "pipeline/engine/steps.h"

#include <memory>

namespace mfar {

/// A still and the steps that match frames with it. What steps return is valid until their next
/// run: each still that is kept has steps of its own.
struct Reference {
    std::unique_ptr<StillStep> still;
    std::unique_ptr<PyramidStep> pyramid;
    std::unique_ptr<FlowStep> flow;
    std::unique_ptr<WeighStep> weigh;
    const StillPictures* pictures = nullptr;  // null: there is no still
    const FlowCells* lastFlow = nullptr;      // belongs to that still
    const CellWeights* lastWeights = nullptr;

    void drop() {
        pictures = nullptr;
        lastFlow = nullptr;
    }
};

}  // namespace mfar
