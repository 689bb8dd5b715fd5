#pragma once

#include "pipeline/slices/hole_tracer.h"
#include "pipeline/slices/traced_renderer_options.h"
#include "pipeline/slices/triple_buffer.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace mfar {

/// Message that a frame has begun.
struct RenderTick {
    std::optional<RenderView> view;  ///< the camera's last valid view
    Timestamp time;
    std::uint64_t number = 0;
};

/// Messages between the thread that handles frames and the workers.
struct RenderMail {
    TripleBuffer<RenderTick> ticks;
    TripleBuffer<std::shared_ptr<const Scene>> scenes;
    TripleBuffer<HoleRequest> holeRequests;
    TripleBuffer<HoleAnswer> holeAnswers;
    TripleBuffer<RenderedPicture> pictures;
    TripleBuffer<RenderCounters> counters;
    TripleBuffer<std::string> errors;
    std::atomic<std::uint32_t> wakes{0};  ///< incremented with each message to the workers
    std::atomic<bool> stop{false};
};

/// State and work of the threads that belong to a TracedRenderer.
class TracedWorkers {
public:
    /// Throws std::invalid_argument if an option is out of range. `mail` must outlive this object.
    TracedWorkers(const TracedRendererOptions& options, RenderMail& mail);

    /// Main function of a thread. It returns when mail.stop is set.
    void work();

    /// Whether frame `number` has begun and `threads` threads sleep, because the budget is used up
    /// or nothing is left to do. Takes a lock.
    [[nodiscard]] bool rest(std::uint64_t number, int threads) const;

private:
    struct Job {
        enum class Kind : unsigned char {
            None,
            Build,  // only one Build job runs at a time
            // Only one Provide or Begin job runs at a time, and not while a picture is resolved.
            Provide,
            Begin,
            Resolve,
            PrepareHoles,  // only one PrepareHoles or AnswerHoles job runs at a time
            AnswerHoles,
            Trace,
            TraceHoles,
        };
        Kind kind = Kind::None;
        BudgetGrant grant;
        TracedPictures::Portion portion;
        PictureResolver::Portion rows;
        std::span<const std::uint32_t> holes;
        int holeSamples = 0;  // samples per pixel of `holes`
        std::shared_ptr<const Scene> source, previousSource;
        // Of a Build job: the previous scene until the job is done, then the new one (null if the
        // previous scene stays in use).
        std::shared_ptr<const PictureScene> scene;
        std::string error;

        [[nodiscard]] std::int64_t samples() const;
    };

    // The functions from here to wakeOthers() are called with mutex_ locked.
    void readMail();
    void takeHoles(HoleRequest& request);
    void takeTick();
    [[nodiscard]] double extraMs() const;
    void look();
    [[nodiscard]] RenderView predictedView() const;
    [[nodiscard]] Job chosenJob();
    [[nodiscard]] Job portion();
    [[nodiscard]] Job resolving();
    void finishRows(const Job& job, double ms);
    void finish(const Job& job, double ms);
    void finishBuild(const Job& job);
    [[nodiscard]] bool tracing() const;
    [[nodiscard]] bool hasWork() const { return toBuild_ || building_ || tracing(); }
    void publishCounters();
    void wakeOthers();
    // perform() and build() are called with mutex_ unlocked.
    void perform(Job& job);
    void build(Job& job) const;

    const TracedRendererOptions options_;
    RenderMail& mail_;
    const std::shared_ptr<FilmMemory> memory_ = Film::makeMemory();

    mutable std::mutex mutex_;
    BudgetController budget_;
    ViewPredictor predictor_;
    TracedPictures pictures_;
    HoleTracer holes_;
    RenderTick tick_;
    std::shared_ptr<const Scene> toBuild_, source_;
    std::shared_ptr<const PictureScene> scene_, shownScene_, holeScene_;
    bool building_ = false;   // a Build job is running
    bool exclusive_ = false;  // a Provide or Begin job is running or a picture is being resolved
    bool resolves_ = false;
    std::array<double, PictureResolver::kStages> resolveMs_{};  // time of each stage [ms per pixel]
    bool holesExclusive_ = false;  // a PrepareHoles or AnswerHoles job is running
    bool toLook_ = false, workAtBegin_ = false;
    double tickSeconds_ = 1.0 / 30;
    double holeMs_ = 0;  // processor time spent on holes in the current frame [ms]
    int asleep_ = 0;
    RenderCounters counters_;
    std::uint64_t samplesThen_ = 0;  // counters_.samples at the time rateTime_
    Timestamp rateTime_;
};

}  // namespace mfar
