#pragma once

#include "pipeline/slices/reference_workers.h"

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace mfar {

/// Makes reference pictures of a scene in threads of its own, of low priority, within a budget of
/// processor time per call of update(); beyond it, and when there is nothing to do, they sleep.
/// Building a scene's search structure is not in the budget. All functions are for one thread, the
/// frame's: none of them waits, takes a lock, or allocates, once the first pictures have been.
class ReferenceRenderer {
public:
    /// Throws std::invalid_argument for options out of range.
    explicit ReferenceRenderer(const ReferenceOptions& options);
    /// Waits for portions of work, a fraction of the budget each, for a picture's conversion, or
    /// for a scene that is being built.
    ~ReferenceRenderer();
    ReferenceRenderer(const ReferenceRenderer&) = delete;
    ReferenceRenderer& operator=(const ReferenceRenderer&) = delete;

    /// Null is a scene of nothing. The newest one wins; the pictures of an older one are shown
    /// until there is one of it. One that is not sound is left alone, see takeError().
    void setScene(std::shared_ptr<const Scene> scene);

    /// A frame begins, `time` its camera's pose; a view that is not sound is taken for the last
    /// one. Once a frame.
    void update(const RenderView& now, Timestamp time);

    /// The newest picture that is complete, null before the first. It stays as it is until the next
    /// call; another one lies at another address.
    [[nodiscard]] const RenderedPicture* newest();

    /// The newest request wins; one that is being traced is answered all the same. Takes the list
    /// by swapping memory with `request`.
    void requestHoles(HoleRequest& request);
    /// The newest answer since the last call, null without one. It stays until the next call.
    [[nodiscard]] const HoleAnswer* takeHoles();

    /// Whether the threads have done what the last update() allows. For measurements, as it takes a
    /// lock.
    [[nodiscard]] bool rests() const {
        return workers_.rest(updates_, static_cast<int>(threads_.size()));
    }

    /// As of the last frame or picture.
    [[nodiscard]] const RenderCounters& counters();
    /// What was wrong with a scene that could not be used, once.
    [[nodiscard]] std::optional<std::string> takeError();

private:
    void wakeOne();

    RenderMail mail_;
    ReferenceWorkers workers_;
    std::optional<RenderView> view_;
    std::uint64_t updates_ = 0;
    bool hasPicture_ = false;
    std::vector<std::jthread> threads_;  // last: they use what is above
};

}  // namespace mfar
