#include "pipeline/slices/traced_renderer.h"

#include "pipeline/slices/view_change.h"

#include <stdexcept>
#include <utility>

namespace mfar {

TracedRenderer::TracedRenderer(const TracedRendererOptions& options,
                               std::shared_ptr<FilmMemory> memory)
    : workers_(options, mail_, std::move(memory)) {
    if (options.threads < 1 || options.threads > 64)
        throw std::invalid_argument("path tracer: the number of threads must be from 1 to 64");
    for (int i = 0; i < options.threads; ++i)
        threads_.emplace_back([this] { workers_.work(); });
}

TracedRenderer::~TracedRenderer() {
    mail_.stop = true;
    ++mail_.wakes;
    mail_.wakes.notify_all();
}

void TracedRenderer::wakeOne() {
    // The woken thread wakes the others if there is work for them.
    ++mail_.wakes;
    mail_.wakes.notify_one();
}

void TracedRenderer::setScene(std::shared_ptr<const Scene> scene) {
    mail_.scenes.back() = scene ? std::move(scene) : std::make_shared<Scene>();
    mail_.scenes.publish();
    wakeOne();
}

void TracedRenderer::update(const RenderView& now, Timestamp time) {
    if (isUsable(now)) {
        view_ = now;
        view_->T_world_camera.rotation.normalize();
    }
    mail_.ticks.back() = {view_, time, ++updates_};
    mail_.ticks.publish();
    wakeOne();
}

const RenderedPicture* TracedRenderer::newest() {
    if (mail_.pictures.fetch()) hasPicture_ = true;
    return hasPicture_ ? &mail_.pictures.front() : nullptr;
}

void TracedRenderer::requestHoles(HoleRequest& request) {
    std::swap(mail_.holeRequests.back(), request);
    mail_.holeRequests.publish();
    wakeOne();
}

const HoleAnswer* TracedRenderer::takeHoles() {
    return mail_.holeAnswers.fetch() ? &mail_.holeAnswers.front() : nullptr;
}

const RenderCounters& TracedRenderer::counters() {
    mail_.counters.fetch();
    return mail_.counters.front();
}

std::optional<std::string> TracedRenderer::takeError() {
    if (!mail_.errors.fetch()) return {};
    return mail_.errors.front();
}

}  // namespace mfar
