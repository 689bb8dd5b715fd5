#pragma once

#include "base/time.h"
#include "pipeline/engine/steps.h"

#include <memory>
#include <vector>

namespace mfar {

/// A still and the steps that match frames with it. Results of a step are valid until its next run,
/// so each kept still has its own steps.
struct Reference {
    std::unique_ptr<StillStep> still;
    std::unique_ptr<PyramidStep> pyramid;
    std::unique_ptr<FlowStep> flow;
    std::unique_ptr<WeighStep> weigh;
    const StillPictures* pictures = nullptr;  // null: no still
    Timestamp time{};                         ///< time of the still
    const FlowCells* lastFlow = nullptr;      // flow of the last frame, for this still
    const CellWeights* lastWeights = nullptr;
    /// Share of the tiles matched with this still that it showed, averaged over recent frames.
    double shows = 1;
    std::vector<WeighedCell> first{};  ///< of the first frame; empty: no frame yet

    void take(const ImageView& picture, Timestamp taken, SuperResMode mode);
    void drop();
    /// Updates `shows` with a frame's numbers of tiles matched and tiles that the still showed.
    void count(int tiles, int shown);
    /// Keeps the weighed cells of the still's first frame.
    void keepFirst();
    /// Mean motion of cells since the still's first frame [video px]: 0 without a frame, infinite
    /// if no cell is matched any more.
    [[nodiscard]] double moved() const;
};

/// Decides which still is kept next to a new one: true for the older of the two, false for the
/// newest so far. Keeps the one that is expected to show more of what the new still misses, judged
/// by the share that it showed so far. The older one is also kept if the camera has hardly moved
/// since the newest was taken: a still from the same place as the new one misses the same areas.
[[nodiscard]] bool keepsOlder(const Reference& older, const Reference& newest);

}  // namespace mfar
