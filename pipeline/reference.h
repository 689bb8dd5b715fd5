#pragma once

#include "base/time.h"
#include "pipeline/engine/steps.h"
#include "pipeline/enlarge/filter_bank.h"

#include <memory>
#include <vector>

namespace mfar {

/// A still and the steps that match frames with it. Each still has its own steps, because the
/// results of a step are valid only until it runs again.
struct Reference {
    std::unique_ptr<StillStep> still;
    std::unique_ptr<PyramidStep> pyramid;
    std::unique_ptr<FlowStep> flow;
    std::unique_ptr<WeighStep> weigh;
    const StillPictures* pictures = nullptr;
    Timestamp time{};
    const FlowCells* lastFlow = nullptr;
    const CellWeights* lastWeights = nullptr;
    /// Share of the tiles matched with this still that show it, averaged over the last frames.
    double shows = 1;
    /// Cells of the first frame that was matched with the still, or empty.
    std::vector<WeighedCell> first{};

    /// Prepares a new still with the tone curve and the guidance of `filters`.
    void take(const ImageView& picture, Timestamp taken, SuperResMode mode,
              const FilterBank& filters);
    void drop();
    /// Updates `shows` after a frame. `tiles` is the number of tiles that were matched with the
    /// still. `shown` is the number of these tiles that show it.
    void count(int tiles, int shown);
    void keepFirst();
    /// Mean change of the cells' flow since the first frame that was matched with the still [video
    /// px]. Only cells with a weight above 0 in both frames count. The result is 0 if `first` is
    /// empty, and otherwise infinite if no cell counts or if the last frame was not matched.
    [[nodiscard]] double moved() const;
};

/// When a third still arrives, only one of the two stills before it is kept as the second still.
/// Returns true if `older` is kept, and false if `newest` is kept or if `older` has no still. The
/// still that was shown in the larger share of its matched tiles is preferred. `older` is also
/// preferred if the camera has hardly moved since `newest`, because `newest` then misses the same
/// areas as the third still.
[[nodiscard]] bool keepsOlder(const Reference& older, const Reference& newest);

}  // namespace mfar
