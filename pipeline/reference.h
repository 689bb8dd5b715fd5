#pragma once

#include "base/time.h"
#include "pipeline/engine/steps.h"

#include <memory>
#include <vector>

namespace mfar {

/// A still and the steps that match frames with this still. A step's results are valid only until
/// the step runs again, so each still has its own steps.
struct Reference {
    std::unique_ptr<StillStep> still;
    std::unique_ptr<PyramidStep> pyramid;
    std::unique_ptr<FlowStep> flow;
    std::unique_ptr<WeighStep> weigh;
    const StillPictures* pictures = nullptr;  // null: no still
    Timestamp time{};                         ///< time of the still
    const FlowCells* lastFlow = nullptr;      // flow of the last frame to this still
    const CellWeights* lastWeights = nullptr;
    /// Share of the tiles matched with this still that the still showed, averaged over recent
    /// frames.
    double shows = 1;
    std::vector<WeighedCell> first{};  ///< cells of the first frame matched with the still; empty:
                                       ///< no frame was matched yet

    void take(const ImageView& picture, Timestamp taken, SuperResMode mode, const StillTone& tone);
    void drop();
    /// Updates `shows` with the counts of a frame. `tiles`: number of tiles matched with this
    /// still; `shown`: number of these tiles that the still showed.
    void count(int tiles, int shown);
    /// Stores the weighed cells of the first frame that was matched with the still.
    void keepFirst();
    /// Mean distance by which the flow of the cells has changed since the first frame matched with
    /// the still [video px]. 0 if no frame was matched yet, infinite if no cell is matched any
    /// more.
    [[nodiscard]] double moved() const;
};

/// Decides which of two stills is kept as the second one when a third still arrives: true: `older`
/// is kept; false: `newest` is kept.
/// The kept still should show more of what the new still misses, judged by the share that it showed
/// so far. The older still is also kept if the camera has hardly moved since the newest was taken:
/// a still from the same camera position as the new one misses the same areas.
[[nodiscard]] bool keepsOlder(const Reference& older, const Reference& newest);

}  // namespace mfar
