#include "tests/measure/eval/metrics/hdrvdp_pathway.h"

#include "tests/measure/eval/metrics/radial_filter.h"

#include <algorithm>
#include <array>

namespace mfar::eval::hdrvdp {
namespace {

constexpr double kSurround = 1e-5;
constexpr double kLeastLight = 1e-5, kMostLight = 1e10;

struct Reception {
    cv::Mat l, m, rod;
};

Reception reception(const cv::Mat& light, const RadialFilter& optics, Emission emission) {
    Reception out{cv::Mat(light.size(), CV_64F, cv::Scalar(0)),
                  cv::Mat(light.size(), CV_64F, cv::Scalar(0)),
                  cv::Mat(light.size(), CV_64F, cv::Scalar(0))};
    for (int c = 0; c < light.channels(); ++c) {
        cv::Mat channel;
        cv::extractChannel(light, channel, c);
        channel = optics.apply(channel, kSurround);
        const ReceptorWeights& w =
            light.channels() == 1 ? kGreyWeights : rgbWeights(emission)[2 - c];
        for (int y = 0; y < channel.rows; ++y) {
            const auto* from = channel.ptr<double>(y);
            auto *l = out.l.ptr<double>(y), *m = out.m.ptr<double>(y), *r = out.rod.ptr<double>(y);
            for (int x = 0; x < channel.cols; ++x) {
                const double v = std::clamp(from[x], kLeastLight, kMostLight);
                l[x] += w.l * v;
                m[x] += w.m * v;
                r[x] += w.rod * v;
            }
        }
    }
    return out;
}

Pathway pathway(const cv::Mat& light, const RadialFilter& optics, const ReceptorResponse& response,
                Emission emission) {
    const Reception seen = reception(light, optics, emission);
    Pathway out{cv::Mat(seen.l + seen.m), cv::Mat(light.size(), CV_64F)};
    for (int y = 0; y < light.rows; ++y) {
        const auto *l = seen.l.ptr<double>(y), *m = seen.m.ptr<double>(y);
        const auto* rod = seen.rod.ptr<double>(y);
        auto* to = out.achromatic.ptr<double>(y);
        for (int x = 0; x < light.cols; ++x)
            to[x] = response.cone(l[x]) + response.cone(m[x]) + response.rod(rod[x]);
    }
    out.achromatic -= cv::mean(out.achromatic);
    return out;
}

}  // namespace

Pathways pathways(const cv::Mat& test, const cv::Mat& reference, double pixelsPerDegree,
                  Emission emission) {
    const RadialFilter optics(test.size(), pixelsPerDegree, opticsGain);
    const ReceptorResponse response;
    const std::array<const cv::Mat*, 2> light{&test, &reference};
    std::array<Pathway, 2> out;
    cv::parallel_for_({0, 2}, [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i)
            out[i] = pathway(*light[i], optics, response, emission);
    });
    return {out[0], out[1]};
}

}  // namespace mfar::eval::hdrvdp
