#pragma once

#include "pipeline/slices/reference_workers.h"

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace mfar {

/// Makes reference pictures of a scene in its own low-priority threads, within a budget of
/// processor time per call of update(); when it is used up or nothing is left to do, they sleep.
/// Building a scene's search structure is not part of the budget. All functions are for one thread,
/// the frame's: none waits or takes a lock, and none allocates after the first pictures.
class ReferenceRenderer {
public:
    /// Throws std::invalid_argument for options out of range.
    explicit ReferenceRenderer(const ReferenceOptions& options);
    /// Waits for running portions of work (each a fraction of the budget), for the conversion of a
    /// picture, or for a scene that is being built.
    ~ReferenceRenderer();
    ReferenceRenderer(const ReferenceRenderer&) = delete;
    ReferenceRenderer& operator=(const ReferenceRenderer&) = delete;

    /// Null: an empty scene. The newest scene wins; pictures of the old one are shown until the new
    /// one has a picture. An invalid scene is ignored, see takeError().
    void setScene(std::shared_ptr<const Scene> scene);

    /// Begins a frame with the camera's pose at `time`. An invalid view is replaced by the last
    /// valid one. Call once per frame.
    void update(const RenderView& now, Timestamp time);

    /// The newest complete picture, null before the first. It stays valid until the next call;
    /// another picture has another address.
    [[nodiscard]] const RenderedPicture* newest();

    /// The newest request wins; a request that is already being traced is still answered. Swaps
    /// memory with `request`.
    void requestHoles(HoleRequest& request);
    /// The newest answer since the last call, or null. It stays valid until the next call.
    [[nodiscard]] const HoleAnswer* takeHoles();

    /// Whether the threads have finished the work that the last update() allows. For measurements:
    /// it takes a lock.
    [[nodiscard]] bool rests() const {
        return workers_.rest(updates_, static_cast<int>(threads_.size()));
    }

    /// State at the last frame or picture.
    [[nodiscard]] const RenderCounters& counters();
    /// Why a scene was rejected; returned once.
    [[nodiscard]] std::optional<std::string> takeError();

private:
    void wakeOne();

    RenderMail mail_;
    ReferenceWorkers workers_;
    std::optional<RenderView> view_;
    std::uint64_t updates_ = 0;
    bool hasPicture_ = false;
    std::vector<std::jthread> threads_;  // last member: the threads use those above
};

}  // namespace mfar
