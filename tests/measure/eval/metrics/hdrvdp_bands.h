#pragma once

#include "tests/measure/eval/metrics/hdrvdp.h"
#include "tests/measure/eval/metrics/hdrvdp_pathway.h"

#include <vector>

namespace mfar::eval::hdrvdp {

class BandComparison {
public:
    BandComparison(Pathways pathways, double pixelsPerDegree);

    [[nodiscard]] std::vector<HdrVdpBand> compare(const cv::Mat& weight) const;

private:
    /// A band of the pyramid. Band 1 and the base have one orientation, other bands have four.
    struct Band {
        std::vector<cv::Mat> difference;
        std::vector<cv::Mat> mutualMask;  ///< smoothed minimum of both pictures' |band value|
        std::vector<double> meanTest, meanReference;
        double frequency = 0, norm = 1;
    };

    static void add(Band& band, const cv::Mat& test, const cv::Mat& reference);
    void decompose(Pathways pathways);
    void addBase(const cv::Mat& test, const cv::Mat& reference, double testLuminance,
                 double referenceLuminance);
    [[nodiscard]] bool isBase(std::size_t b) const { return b + 1 == bands_.size(); }
    [[nodiscard]] cv::Mat sensitivity(std::size_t b) const;
    [[nodiscard]] cv::Mat neighbours(std::size_t b, std::size_t o) const;
    [[nodiscard]] HdrVdpBand compare(std::size_t b, std::size_t o, const cv::Mat& sensitivity,
                                     const cv::Mat& weight) const;

    double pixelsPerDegree_;
    cv::Mat logLuminance_;
    std::vector<Band> bands_;
};

}  // namespace mfar::eval::hdrvdp
