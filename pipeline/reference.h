#pragma once

#include "base/time.h"
#include "pipeline/engine/steps.h"

#include <memory>
#include <vector>

namespace mfar {

/// A still and the steps that match frames with it. Results of a step are valid only until its next
/// run, so each still has its own steps.
struct Reference {
    std::unique_ptr<StillStep> still;
    std::unique_ptr<PyramidStep> pyramid;
    std::unique_ptr<FlowStep> flow;
    std::unique_ptr<WeighStep> weigh;
    const StillPictures* pictures = nullptr;
    Timestamp time{};
    const FlowCells* lastFlow = nullptr;
    const CellWeights* lastWeights = nullptr;
    /// Number of tiles that this still showed, divided by the number of tiles that were matched
    /// with it. Averaged over recent frames.
    double shows = 1;
    /// Cells of the first frame that was matched with the still, or empty.
    std::vector<WeighedCell> first{};

    void take(const ImageView& picture, Timestamp taken, SuperResMode mode, const StillTone& tone);
    void drop();
    /// Updates `shows` after a frame: `tiles` is the number of tiles matched with the still,
    /// `shown` the number of those that the still shows.
    void count(int tiles, int shown);
    void keepFirst();
    /// Mean change of the cells' flow since the first frame matched with the still [video px]. 0 if
    /// no frame was matched yet, infinite if no cell is matched any more.
    [[nodiscard]] double moved() const;
};

/// Decides which of two stills becomes the second still when a third one arrives. True: `older`;
/// false: `newest`. The still that has shown the larger share of its matched tiles is preferred.
/// `older` is also preferred if the camera has hardly moved since `newest`: then `newest` misses
/// the same areas as the third still.
[[nodiscard]] bool keepsOlder(const Reference& older, const Reference& newest);

}  // namespace mfar
