#include "pipeline/slices/traced_workers.h"

#include "base/thread_priority.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

// Upper limit of viewChange() from the present to the predicted view. It is below 1, because the
// picture must also serve the present view.
constexpr double kPredictedChange = 0.9;
// Upper limit of the number of frame budgets granted at once, after a job that lasted many frames.
constexpr std::uint64_t kMostMissed = 16;
constexpr double kRateSeconds = 1;
constexpr std::int64_t kFirstResolved = 2048;

TracedRendererOptions checked(const TracedRendererOptions& o) {
    const auto positive = [](double v) { return std::isfinite(v) && v > 0; };
    validate(o.tracer);
    if (!positive(o.policy.limits.turnDegrees) || !positive(o.policy.limits.zoom) ||
        !(o.lightChange >= 0) || o.policy.samplesToReplace < 1)
        throw std::invalid_argument(
            "path tracer: turnDegrees and zoom must be above 0, lightChange must not be negative, "
            "and samplesToReplace must be at least 1");
    if (!(std::isfinite(o.policy.shownWithin) && o.policy.shownWithin >= 0))
        throw std::invalid_argument("path tracer: shownWithin must be finite and not negative");
    if (!(o.holeShare >= 0 && o.holeShare <= 1))
        throw std::invalid_argument("path tracer: holeShare must be from 0 to 1");
    if (!positive(o.exposure.scale))
        throw std::invalid_argument(
            "path tracer: the scale of the exposure must be finite and above 0");
    return o;
}

}  // namespace

TracedWorkers::TracedWorkers(const TracedRendererOptions& options, RenderMail& mail,
                             std::shared_ptr<FilmMemory> memory)
    : options_(checked(options)), mail_(mail), budget_(options.budgetMs),
      predictor_(options.prediction), pictures_(options.slices, options.policy, memory),
      holes_(options.mostHolePixels, std::move(memory)) {}

void TracedWorkers::work() {
    const bool lowered = lowerThreadPriority();
    std::unique_lock lock(mutex_);
    counters_.lowPriority = counters_.lowPriority && lowered;
    while (!mail_.stop) {
        // `wakes` must be read before the mail, so that a later message ends the wait below.
        const std::uint32_t wakes = mail_.wakes;
        readMail();
        Job job = chosenJob();
        if (job.kind == Job::Kind::None) {
            ++asleep_;
            lock.unlock();
            mail_.wakes.wait(wakes);
            lock.lock();
            --asleep_;
            continue;
        }
        lock.unlock();
        const double begin = threadCpuMs();
        perform(job);
        const double ms = threadCpuMs() - begin;
        lock.lock();
        finish(job, ms);
    }
}

bool TracedWorkers::rest(std::uint64_t number, int threads) const {
    const std::scoped_lock lock(mutex_);
    return tick_.number == number && asleep_ == threads && !toBuild_ && !building_;
}

void TracedWorkers::readMail() {
    if (mail_.scenes.fetch()) toBuild_ = std::exchange(mail_.scenes.front(), nullptr);
    if (!holesExclusive_ && holes_.idle() && scene_ && mail_.holeRequests.fetch())
        takeHoles(mail_.holeRequests.front());
    if (mail_.ticks.fetch()) takeTick();
}

// Drops the request if its scene is neither shown nor traced any more. The next picture will cause
// a new request.
void TracedWorkers::takeHoles(HoleRequest& request) {
    const std::shared_ptr<const Scene> source = std::exchange(request.source, nullptr);
    const std::shared_ptr<const PictureScene>& scene =
        source && shownScene_ && shownScene_->source == source ? shownScene_ : scene_;
    if (source && scene->source != source) return;
    holes_.take(request);
    holeScene_ = scene;
}

void TracedWorkers::takeTick() {
    const RenderTick last = std::exchange(tick_, mail_.ticks.front());
    const bool waits = tracing();
    for (std::uint64_t i = std::min(tick_.number - last.number, kMostMissed); i > 0; --i)
        budget_.beginFrame(workAtBegin_ && waits, extraMs());
    workAtBegin_ = waits;
    holeMs_ = 0;
    if (tick_.view) predictor_.add(tick_.view->T_world_camera, tick_.time);
    // A thread that works on the scene for several frames takes only the newest tick.
    const auto frames = static_cast<double>(tick_.number - last.number);
    const double seconds = secondsBetween(last.time, tick_.time) / frames;
    if (last.number > 0 && seconds > 0 && seconds < 1)
        tickSeconds_ += 0.1 * (seconds - tickSeconds_);
    toLook_ = tick_.view.has_value();
    const double sinceRate = secondsBetween(rateTime_, tick_.time);
    if (!(sinceRate >= 0 && sinceRate < kRateSeconds)) {
        const auto traced = static_cast<double>(counters_.samples - samplesThen_);
        counters_.samplesPerSecond = sinceRate > 0 ? traced / sinceRate : 0;
        samplesThen_ = counters_.samples;
        rateTime_ = tick_.time;
    }
    publishCounters();
    if (hasWork()) wakeOthers();
}

// Before the first picture, the warp has nothing to do in a frame. So the path tracer gets twice
// the budget, and the first picture is shown sooner.
double TracedWorkers::extraMs() const {
    return counters_.shown == 0 ? budget_.msPerFrame() : 0;
}

void TracedWorkers::look() {
    toLook_ = false;
    pictures_.setScene(scene_);
    pictures_.setBudget({budget_.msPerFrame(), extraMs(), tickSeconds_});
    if (scene_ && tick_.view) pictures_.look(*tick_.view, predictedView(), tick_.time);
    publishCounters();
    if (hasWork()) wakeOthers();
}

RenderView TracedWorkers::predictedView() const {
    const RenderView& now = *tick_.view;
    double distance = std::numeric_limits<double>::infinity();
    for (const ObjectBall& ball : scene_->balls)
        distance = std::min(distance, (ball.centre - now.T_world_camera.translation).norm());
    if (!std::isfinite(distance)) return now;
    const int samples = std::min(options_.slices.samples, options_.policy.samplesToReplace);
    const double ms = static_cast<double>(pictures_.pixels()) * samples * budget_.msPerSample();
    double seconds =
        std::min(ms / budget_.msPerFrame() * tickSeconds_, options_.prediction.seconds);
    for (int i = 0; i < 4; ++i, seconds /= 2) {
        const RenderView there{now.camera, predictor_.predict(seconds, distance)};
        if (scene_->changeOf(now, there, options_.policy.limits) < kPredictedChange) return there;
    }
    return now;
}

TracedWorkers::Job TracedWorkers::chosenJob() {
    Job job;
    if (toBuild_ && !building_) {
        building_ = true;
        job.kind = Job::Kind::Build;
        job.source = std::exchange(toBuild_, nullptr);
        job.previousSource = source_;
        job.scene = scene_;
        return job;
    }
    if (!holesExclusive_ && (holes_.taken() || holes_.complete())) {
        holesExclusive_ = true;
        job.kind = holes_.taken() ? Job::Kind::PrepareHoles : Job::Kind::AnswerHoles;
        return job;
    }
    if (!exclusive_) {
        if (toLook_) look();
        if (pictures_.toBegin()) {
            exclusive_ = true;
            job.kind = pictures_.lacksMemory() ? Job::Kind::Provide : Job::Kind::Begin;
            return job;
        }
        if (pictures_.toShow()) {
            exclusive_ = resolves_ = true;
            pictures_.beginShow(options_.exposure, mail_.pictures.back());
        }
    }
    return portion();
}

TracedWorkers::Job TracedWorkers::resolving() {
    Job job;
    PictureResolver& resolver = pictures_.resolver();
    const double ms = resolveMs_[static_cast<std::size_t>(resolver.stage())];
    const std::int64_t pixels =
        ms > 0 ? static_cast<std::int64_t>(std::min(budget_.portionMs() / ms, 1e9))
               : kFirstResolved;
    job.grant = budget_.grant(ms * static_cast<double>(pixels));
    if (job.grant.samples == 0) return job;
    job.rows = resolver.next(pixels);
    job.kind = Job::Kind::Resolve;
    return job;
}

TracedWorkers::Job TracedWorkers::portion() {
    Job job;
    const bool holesWait = !holesExclusive_ && holes_.tracing();
    const bool picturesWait = !exclusive_ && !pictures_.settled();
    const bool rowsWait = resolves_ && pictures_.resolver().hasNext();
    if (!holesWait && !picturesWait && !rowsWait) return job;
    const bool holesTurn = holeMs_ <= options_.holeShare * budget_.used();
    if (rowsWait && !(holesWait && holesTurn)) return resolving();
    job.grant = budget_.grant();
    if (job.grant.samples == 0) return job;
    if (picturesWait && !(holesWait && holesTurn)) {
        job.portion = pictures_.next(job.grant.samples);
        if (!job.portion.slice.pixels.empty()) {
            job.kind = Job::Kind::Trace;
            return job;
        }
    }
    if (holesWait) {
        job.kind = Job::Kind::TraceHoles;
        job.holes = holes_.next(job.grant.samples);
        job.holeSamples = holes_.request().samples;
        job.scene = holeScene_;
        return job;
    }
    budget_.spent(job.grant, 0, 0);
    return {};
}

void TracedWorkers::perform(Job& job) {
    switch (job.kind) {
    case Job::Kind::None: break;
    case Job::Kind::Build: build(job); break;
    case Job::Kind::Provide: pictures_.provide(mail_.pictures.back()); break;
    case Job::Kind::Begin: pictures_.begin(); break;
    case Job::Kind::Resolve: pictures_.resolver().run(job.rows); break;
    case Job::Kind::PrepareHoles:
        holes_.prepare();
        if (holeScene_->moves() && holes_.request().poses.size() == holeScene_->poses.size())
            holeScene_ = posed(*holeScene_, holes_.request().poses);
        break;
    case Job::Kind::AnswerHoles: holes_.answer(options_.exposure, mail_.holeAnswers.back()); break;
    case Job::Kind::Trace: pictures_.trace(job.portion); break;
    case Job::Kind::TraceHoles:
        job.scene->tracer->trace(holes_.request().view, job.holes, job.holeSamples, holes_.film());
        break;
    }
}

void TracedWorkers::build(Job& job) const {
    const std::shared_ptr<const PictureScene> previous = std::exchange(job.scene, nullptr);
    try {
        const bool same = job.source && previous && sameObjects(*job.source, *job.previousSource);
        if (same &&
            lightChange(job.source->lighting, job.previousSource->lighting) < options_.lightChange)
            return;
        auto built = std::make_shared<PictureScene>(pictureScene(job.source, options_.tracer));
        built->objects = (previous ? previous->objects : 0) + (same ? 0 : 1);
        built->light = (previous ? previous->light : 0) + 1;
        job.scene = std::move(built);
    } catch (const std::exception& e) {
        job.error = e.what();
    }
}

std::int64_t TracedWorkers::Job::samples() const {
    return static_cast<std::int64_t>(portion.slice.pixels.size()) * portion.slice.samples +
           static_cast<std::int64_t>(holes.size()) * holeSamples;
}

void TracedWorkers::finish(const Job& job, double ms) {
    const std::int64_t samples = job.samples();
    counters_.samples += static_cast<std::uint64_t>(samples);
    // The budget does not include work that is done once per scene.
    const bool isOnce = job.kind == Job::Kind::Build || job.kind == Job::Kind::Provide;
    if (!isOnce) counters_.cpuMs += ms;
    switch (job.kind) {
    case Job::Kind::None: return;
    case Job::Kind::Build: finishBuild(job); break;
    case Job::Kind::Resolve: return finishRows(job, ms);
    case Job::Kind::Provide: exclusive_ = false; break;
    case Job::Kind::Begin:
        exclusive_ = false;
        budget_.spentElsewhere(ms);
        break;
    case Job::Kind::AnswerHoles: mail_.holeAnswers.publish(); [[fallthrough]];
    case Job::Kind::PrepareHoles:
        holesExclusive_ = false;
        budget_.spentElsewhere(ms);
        break;
    case Job::Kind::Trace:
        pictures_.done(job.portion, options_.exposure, ms);
        budget_.spent(job.grant, samples, ms);
        if (!exclusive_ && pictures_.turnComplete()) wakeOthers();
        return;
    case Job::Kind::TraceHoles:
        holes_.done(job.holes);
        holeMs_ += ms;
        budget_.spent(job.grant, samples, ms);
        return;
    }
    publishCounters();
    wakeOthers();
}

void TracedWorkers::finishRows(const Job& job, double ms) {
    PictureResolver& resolver = pictures_.resolver();
    resolveMs_[static_cast<std::size_t>(job.rows.stage)] =
        ms / static_cast<double>(resolver.pixelsOf(job.rows));
    budget_.spent(job.grant, 0, ms);
    convertedMs_ += ms;
    resolver.done(job.rows);
    if (resolver.complete()) {
        pictures_.endShow(mail_.pictures.back(), std::exchange(convertedMs_, 0));
        mail_.pictures.publish();
        shownScene_ = pictures_.shownScene();
        ++counters_.shown;
        exclusive_ = resolves_ = false;
        publishCounters();
    }
    if (resolver.complete() || resolver.hasNext()) wakeOthers();
}

void TracedWorkers::finishBuild(const Job& job) {
    building_ = false;
    if (!job.error.empty()) {
        mail_.errors.back() = job.error;
        mail_.errors.publish();
    }
    if (!job.scene) return;
    scene_ = job.scene;
    source_ = job.source;
    toLook_ = true;
}

bool TracedWorkers::tracing() const {
    return exclusive_ || !pictures_.settled() || holesExclusive_ || !holes_.idle();
}

void TracedWorkers::publishCounters() {
    counters_.frame = tick_.time;
    counters_.msPerSample = budget_.msPerSample();
    counters_.budget = budget_.kept();
    // While toLook_ is set, a new scene or view may still need work.
    counters_.idle = !hasWork() && !toLook_;
    if (!holesExclusive_) counters_.holePixels = holes_.answered();
    if (!exclusive_) {
        counters_.pictures = pictures_.finished();
        counters_.progress = pictures_.progress();
        counters_.shownSince = pictures_.shownSince();
    }
    mail_.counters.back() = counters_;
    mail_.counters.publish();
}

void TracedWorkers::wakeOthers() {
    if (asleep_ == 0) return;
    ++mail_.wakes;
    mail_.wakes.notify_all();
}

}  // namespace mfar
