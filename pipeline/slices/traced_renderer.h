#pragma once

#include "pipeline/slices/traced_workers.h"

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace mfar {

/// Renders traced pictures of a scene in its own low-priority threads. The threads have a budget of
/// processor time per call of update(). They sleep if this time is used up or no work is left.
/// Building a scene's search structure and providing its memory are not part of the budget.
/// All functions must be called by the thread that handles the frames. No function except rests()
/// and the destructor waits or takes a lock. After the first pictures, only setScene() and
/// takeError() can allocate memory.
class TracedRenderer {
public:
    /// `memory` is for the films. Throws std::invalid_argument if an option is out of range.
    explicit TracedRenderer(const TracedRendererOptions& options,
                            std::shared_ptr<FilmMemory> memory = Film::makeMemory());
    /// Waits for the running portions of work, and for a scene that is being built. Work that has
    /// not begun is discarded.
    ~TracedRenderer();
    TracedRenderer(const TracedRenderer&) = delete;
    TracedRenderer& operator=(const TracedRenderer&) = delete;

    /// Sets a new scene; null is an empty scene. Only the newest scene is used. Pictures of the old
    /// scene are shown until the new scene has a picture. An invalid scene is ignored; see
    /// takeError().
    void setScene(std::shared_ptr<const Scene> scene);

    /// Begins a frame with the camera's pose at `time`. Must be called once per frame. If the view
    /// is invalid, the last valid view is used.
    void update(const RenderView& now, Timestamp time);

    /// Newest complete picture; null before the first. It stays valid until the next call of
    /// newest(). Two successive pictures have different addresses.
    [[nodiscard]] const RenderedPicture* newest();

    /// Requests single pixels. Only the newest request is used, but a request in progress is still
    /// answered. In exchange, `request` gets the memory of an older request.
    void requestHoles(HoleRequest& request);
    /// Newest answer to a hole request since the last call, or null. It is valid until the next
    /// call.
    [[nodiscard]] const HoleAnswer* takeHoles();

    /// True if the threads have finished the work that the last update() allows. It takes a lock,
    /// so use it only for measurements.
    [[nodiscard]] bool rests() const {
        return workers_.rest(updates_, static_cast<int>(threads_.size()));
    }

    /// Counters at the last frame, picture, built scene or answered hole request, whichever is
    /// newest.
    [[nodiscard]] const RenderCounters& counters();
    /// Reason why a scene was rejected; empty if none was rejected since the last call.
    [[nodiscard]] std::optional<std::string> takeError();

private:
    void wakeOne();

    RenderMail mail_;
    TracedWorkers workers_;
    std::optional<RenderView> view_;
    std::uint64_t updates_ = 0;
    bool hasPicture_ = false;
    // Must stay the last member, because the threads use all other members.
    std::vector<std::jthread> threads_;
};

}  // namespace mfar
