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
    /// Of the tiles that were matched with this still, the share that the still showed, averaged
    /// over recent frames.
    double shows = 1;
    std::vector<WeighedCell> first{};  ///< cells of the first frame; empty: no frame yet

    void take(const ImageView& picture, Timestamp taken, SuperResMode mode);
    void drop();
    /// Updates `shows` from a frame. `tiles`: number of tiles matched; `shown`: number of these
    /// tiles that the still showed.
    void count(int tiles, int shown);
    /// Stores the weighed cells of the first frame that was matched with the still.
    void keepFirst();
    /// Mean motion of the cells since the still's first frame [video px]. 0 before a frame,
    /// infinite if no cell is matched any more.
    [[nodiscard]] double moved() const;
};

/// Decides which still is kept when a third one arrives: true for the older, false for the newest
/// so far.
/// The kept still should show more of what the new still misses, judged by the share that it showed
/// so far. The older still is also kept if the camera has hardly moved since the newest was taken:
/// a still from the same place as the new one misses the same areas.
[[nodiscard]] bool keepsOlder(const Reference& older, const Reference& newest);

}  // namespace mfar
