#include "tests/measure/bench/curves.h"

#include "pipeline/pipeline.h"
#include "tests/measure/bench/knobs.h"
#include "tests/measure/bench/summary.h"
#include "tests/measure/eval/metrics/flow_error.h"
#include "tests/measure/eval/paper_pipeline.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/rig_resample.h"
#include "tests/measure/eval/stage_share.h"
#include "tests/measure/eval/stopwatch.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <stdexcept>

namespace mfar::bench {
namespace {

CurvePoint pointOf(const CurveSample& sample, const cv::Mat& flow, double ms) {
    const eval::FlowError error = eval::flowError(flow, sample.truth);
    return {0, false, ms, error.epe, error.bad1};
}

void addShare(CurvePoint& sum, const CurvePoint& part, std::size_t parts) {
    const auto n = static_cast<double>(parts);
    sum.ms += part.ms / n;
    sum.epe += part.epe / n;
    sum.bad1 += part.bad1 / n;
}

CurvePoint measure(const CurveSample& sample, PipelineOptions options, bool alongLines) {
    options.output = sample.rig.video.size;
    options.skipUnchanged = false;
    Pipeline pipeline(sample.rig, options);
    pipeline.setMeasure(true);
    const cv::Mat frame = eval::toRgba(sample.frame.picture);
    const cv::Mat still = eval::toRgba(sample.still.picture);
    const auto run = [&] {
        // Setting the still again discards the previous result, so no run starts from it.
        pipeline.setStill(eval::viewOf(still), sample.still.time,
                          alongLines ? sample.still.pose : std::nullopt);
        const double ms = eval::wallMs([&] {
            pipeline.run(eval::viewOf(frame), sample.frame.time,
                         alongLines ? sample.frame.pose : std::nullopt);
        });
        return ms * eval::shareOfStages(pipeline, eval::kFlowStages);
    };
    run();
    std::vector<float> vectors = pipeline.readFlow();
    const cv::Mat flow(frame.size(), CV_32FC2, vectors.data());
    return pointOf(sample, flow, summarise({run(), run(), run()}).median);
}

CurvePoint mean(const std::vector<CurveSample>& samples, const PipelineOptions& options,
                bool alongLines) {
    const auto fits = [&](const CurveSample& s) { return !alongLines || s.hasPoses(); };
    const auto count = static_cast<std::size_t>(std::ranges::count_if(samples, fits));
    CurvePoint out;
    for (const CurveSample& sample : samples)
        if (fits(sample)) addShare(out, measure(sample, options, alongLines), count);
    return out;
}

CurvePeer peer(const char* name, eval::DisPreset preset, const std::vector<CurveSample>& samples) {
    CurvePeer out{name, {}};
    const auto dis = eval::createDis(preset);
    for (const CurveSample& sample : samples) {
        cv::Mat frame, still, flow;
        cv::cvtColor(sample.frame.picture, frame, cv::COLOR_BGR2GRAY);
        cv::cvtColor(eval::resampleStill(sample.still.picture, sample.rig), still,
                     cv::COLOR_BGR2GRAY);
        const auto run = [&] {
            flow.release();  // otherwise DIS would start from the last result
            return eval::wallMs([&] { dis->calc(frame, still, flow); });
        };
        run();
        const double ms = summarise({run(), run(), run()}).median;
        addShare(out.point, pointOf(sample, flow, ms), samples.size());
    }
    return out;
}

Curve measure(const Knob& knob, const std::vector<CurveSample>& samples,
              const CurvePoint& byDefault, bool alongLines) {
    Curve out{knob.method, knob.name, {}};
    for (const double value : knob.values) {
        PipelineOptions options;
        const bool isDefault = value == knob.get(options);
        knob.set(options, value);
        CurvePoint point = isDefault ? byDefault : mean(samples, options, alongLines);
        point.value = value;
        point.isDefault = isDefault;
        out.points.push_back(point);
    }
    return out;
}

}  // namespace

Curves measureCurves(const std::vector<CurveSample>& samples, const ProgressPart& progress) {
    if (samples.empty()) throw std::invalid_argument("the curves need at least one sample");
    Curves out;
    for (const CurveSample& sample : samples)
        out.samples.push_back(sample.name);
    const bool anyPoses = std::ranges::any_of(samples, &CurveSample::hasPoses);
    const CurvePoint defaults[] = {mean(samples, {}, false), mean(samples, {}, true)};
    std::size_t done = 0;
    for (const Knob& knob : flowKnobs()) {
        progress.show(done++, flowKnobs().size(), fmt::format("{} {}", knob.method, knob.name));
        const bool alongLines = knob.method == "epipolar";
        if (!alongLines || anyPoses)
            out.curves.push_back(measure(knob, samples, defaults[alongLines ? 1 : 0], alongLines));
    }
    out.peers.push_back(peer("DIS fast", eval::DisPreset::Fast, samples));
    out.peers.push_back(peer("DIS medium", eval::DisPreset::Medium, samples));
    return out;
}

}  // namespace mfar::bench
