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

struct RenderTick {
    std::optional<RenderView> view;
    Timestamp time;
    std::uint64_t number = 0;
};

struct RenderMail {
    TripleBuffer<RenderTick> ticks;
    TripleBuffer<std::shared_ptr<const Scene>> scenes;
    TripleBuffer<HoleRequest> holeRequests;
    TripleBuffer<HoleAnswer> holeAnswers;
    TripleBuffer<RenderedPicture> pictures;
    TripleBuffer<RenderCounters> counters;
    TripleBuffer<std::string> errors;
    std::atomic<std::uint32_t> wakes{0};  ///< incremented to wake workers
    std::atomic<bool> stop{false};
};

class TracedWorkers {
public:
    /// `memory` is for the films. Throws std::invalid_argument if an option is out of range. `mail`
    /// must outlive this object.
    TracedWorkers(const TracedRendererOptions& options, RenderMail& mail,
                  std::shared_ptr<FilmMemory> memory);

    /// Runs in each thread until mail.stop is set.
    void work();

    /// True if frame `number` has begun and `threads` threads sleep. Takes a lock.
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
        int holeSamples = 0;
        std::shared_ptr<const Scene> source, previousSource;
        // A Build job gets the previous scene here and returns the new one. A null result keeps
        // the previous scene.
        std::shared_ptr<const PictureScene> scene;
        std::string error;

        [[nodiscard]] std::int64_t samples() const;
    };

    // The functions from here to wakeOthers() require a locked mutex_.
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
    // perform() and build() require an unlocked mutex_.
    void perform(Job& job);
    void build(Job& job) const;

    const TracedRendererOptions options_;
    RenderMail& mail_;

    mutable std::mutex mutex_;
    BudgetController budget_;
    ViewPredictor predictor_;
    TracedPictures pictures_;
    HoleTracer holes_;
    RenderTick tick_;
    std::shared_ptr<const Scene> toBuild_, source_;
    std::shared_ptr<const PictureScene> scene_, shownScene_, holeScene_;
    bool building_ = false;
    bool exclusive_ = false;  // true while a Provide or Begin job runs or a picture is resolved
    bool resolves_ = false;
    std::array<double, PictureResolver::kStages> resolveMs_{};  // [ms per pixel]
    double convertedMs_ = 0;       // time spent so far on the picture that is being resolved [ms]
    bool holesExclusive_ = false;  // true while a PrepareHoles or AnswerHoles job runs
    bool toLook_ = false, workAtBegin_ = false;
    double tickSeconds_ = 1.0 / 30;
    double holeMs_ = 0;  // time for hole requests in the current frame [ms]
    int asleep_ = 0;
    RenderCounters counters_;
    std::uint64_t samplesThen_ = 0;  // value of counters_.samples at rateTime_
    Timestamp rateTime_;
};

}  // namespace mfar
