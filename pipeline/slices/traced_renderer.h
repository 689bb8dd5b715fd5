#pragma once

#include "pipeline/slices/traced_workers.h"

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace mfar {

/// Makes traced pictures of a scene in its own low-priority threads. The threads have a budget
/// of processor time for each call of update(). They sleep if the budget is used up or nothing is
/// left to do. Building a scene's search structure is not part of the budget.
/// All functions are for one thread, which handles the frames. No function waits or takes a lock,
/// and none allocates memory after the first pictures.
class TracedRenderer {
public:
    /// Throws std::invalid_argument if an option is out of range.
    explicit TracedRenderer(const TracedRendererOptions& options);
    /// Waits until running portions of work (each takes a fraction of the budget), the conversion
    /// of a picture, and the building of a scene are finished.
    ~TracedRenderer();
    TracedRenderer(const TracedRenderer&) = delete;
    TracedRenderer& operator=(const TracedRenderer&) = delete;

    /// Sets a new scene; null is an empty scene. If several scenes were set, only the newest is
    /// used. Pictures of the old scene are shown until the new scene has a picture. An invalid
    /// scene is ignored; see takeError().
    void setScene(std::shared_ptr<const Scene> scene);

    /// Begins a frame with the camera's pose at `time`. If the view is invalid, the last valid view
    /// is used. Must be called once per frame.
    void update(const RenderView& now, Timestamp time);

    /// The newest complete picture; null before the first. It stays valid until the next call of
    /// newest(). Two successive pictures have different addresses.
    [[nodiscard]] const RenderedPicture* newest();

    /// Requests pixels that are rendered individually. Only the newest request is used, but a
    /// request that is already being traced is still answered. `request` gets the memory of an
    /// older request.
    void requestHoles(HoleRequest& request);
    /// The newest answer to a hole request since the last call, or null. It is valid until the next
    /// call.
    [[nodiscard]] const HoleAnswer* takeHoles();

    /// Whether the threads have finished the work that the last update() allows. It takes a lock,
    /// so it is only for measurements.
    [[nodiscard]] bool rests() const {
        return workers_.rest(updates_, static_cast<int>(threads_.size()));
    }

    /// The counters as of the last frame or the last picture, whichever is newer.
    [[nodiscard]] const RenderCounters& counters();
    /// The reason why a scene was rejected; empty if none was rejected since the last call.
    [[nodiscard]] std::optional<std::string> takeError();

private:
    void wakeOne();

    RenderMail mail_;
    TracedWorkers workers_;
    std::optional<RenderView> view_;
    std::uint64_t updates_ = 0;
    bool hasPicture_ = false;
    std::vector<std::jthread> threads_;  // last member, because the threads use the other members
};

}  // namespace mfar
