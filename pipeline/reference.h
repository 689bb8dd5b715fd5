#pragma once

#include "base/time.h"
#include "pipeline/engine/steps.h"

#include <memory>
#include <vector>

namespace mfar {

/// A still and the steps that match frames with it. What steps return is valid until their next
/// run: each still that is kept has steps of its own.
struct Reference {
    std::unique_ptr<StillStep> still;
    std::unique_ptr<PyramidStep> pyramid;
    std::unique_ptr<FlowStep> flow;
    std::unique_ptr<WeighStep> weigh;
    const StillPictures* pictures = nullptr;  // null: there is no still
    Timestamp time{};                         ///< of the still
    const FlowCells* lastFlow = nullptr;      // belongs to that still
    const CellWeights* lastWeights = nullptr;
    /// Of the tiles that were to be matched with it, the share that it showed, over some frames.
    double shows = 1;
    std::vector<WeighedCell> first{};  ///< as of the first frame; empty: there was none

    void take(const ImageView& picture, Timestamp taken, SuperResMode mode);
    void drop();
    /// A frame's tiles that were to be matched, and those that the still showed.
    void count(int tiles, int shown);
    /// Keeps the weighed cells of the still's first frame.
    void keepFirst();
    /// How far cells have moved in the mean since the still's first frame [video px]: 0 before any,
    /// infinite where none is matched any more.
    [[nodiscard]] double moved() const;
};

/// Is the older of two stills to be kept beside a new one, and not the one that was the newest
/// until now? The one is kept that is expected to show more of what the new one misses: as much as
/// it showed of what it was matched for. Nothing where the camera has hardly moved since the newest
/// was new: a still from the same place as the new one misses the same.
[[nodiscard]] bool keepsOlder(const Reference& older, const Reference& newest);

}  // namespace mfar
