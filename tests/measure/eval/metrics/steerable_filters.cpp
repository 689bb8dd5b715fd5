#include "tests/measure/eval/metrics/steerable_filters.h"

#include <Eigen/Core>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <span>

namespace mfar::eval {
namespace {

// Coefficients of sp3Filters in matlabPyrTools, (c) 2015 LabForComputationalVision, MIT licence.
// Coefficients that follow by symmetry are omitted.

// Coefficients of one octant of a symmetric filter. Each row runs from the axis to the diagonal;
// rows go downwards from the centre.
constexpr std::array<double, 36> kHighPass{
    0.7303866148,      -0.1554141641,    -0.079501636326,   -0.0093812197447,  0.0078046298586,
    0.013962360099,    0.0073032598011,  0.0053632198833,   -0.0027556000277,  -0.0063222697936,
    -0.0051014497876,  -0.0045751798898, -0.0031295299996,  -0.00049274001503, 0.0012960999738,
    -0.00083368999185, 0.00033578000148, 0.0021145299543,   0.0022253401112,   0.0014050999889,
    0.0011793200392,   0.0019755100366,  0.0022892199922,   0.0025626500137,   0.0021750701126,
    0.0015874400269,   0.00077435001731, -0.00032734998967, 0.0020898699295,   0.0020687500946,
    0.0019235999789,   0.0015450799838,  0.00088387000142,  -3.7829999201e-05, -0.00062596000498,
    -0.000404839986};
constexpr std::array<double, 15> kFirstLowPass{
    0.4376249909,    0.181160301,       0.043813198805,  -0.032971370965,  -0.037694871426,
    -0.007061290089, 0.0011076199589,   0.0082244202495, 0.0075227199122,  0.0029215801042,
    0.0025240099058, -0.00050337001448, -0.001601260039, -0.0013542800443, -8.7009997515e-05};
constexpr std::array<double, 45> kLowPass{
    0.2120374441,      0.1773651242,      0.1445499808,      0.090580143034,    0.068065837026,
    0.021906599402,    0.014385120012,    0.0039556599222,   -0.011091699824,   -0.020229380578,
    -0.016485679895,   -0.017508180812,   -0.018847439438,   -0.012604200281,   -0.0035306399222,
    -0.0096372198313,  -0.0090569201857,  -0.0074316998944,  -0.0017774800071,  0.0031846798956,
    0.0031757799443,   0.00055381999118,  0.0022212199401,   0.0041121998802,   0.0030809799209,
    0.0037613599561,   0.0021605400834,   0.0014607800404,   0.0055893999524,   0.0042872801423,
    0.0028898599558,   0.0023255399428,   -0.00013688000035, 0.00056215998484,  -0.00058146001538,
    0.00044606000301,  0.001261999947,    -0.00042019999819, -0.00025168000138, -0.0015970399836,
    -0.00080063997302, -0.00012434000382, -0.00067714002216, 0.00012078000145,  -4.3500000174e-05};
// Coefficients to the right of the centre, from the centre row downwards. The filter is odd
// horizontally and even vertically.
constexpr std::array<double, 20> kVertical{
    0.1768419296,     -0.053605638444,   -0.0085267601535, -0.01417945046,   0.1105690673,
    -0.039442278445,  0.0028760801069,   -0.013955879956,  0.022522680461,   -0.0082581602037,
    0.0058724298142,  -0.012316980399,   0.00036522001028, 0.0037740699481,  -0.004456540104,
    -0.0044451598078, -0.00074700999539, -0.0013462699717, -0.0039103501476, 0.00081125000725};
// Coefficients above both diagonals, from the top. The filter is odd about the falling diagonal and
// even about the rising one.
constexpr std::array<double, 20> kDiagonal{
    0.00082846998703, 5.7109999034e-05, -4.0110000555e-05, -0.0046670897864, -0.0080871898681,
    -0.014807609841,  -0.0086204400286, 0.0031221499667,   0.00097479997203, 0.0069718998857,
    0.002086560009,   -0.002329879906,  0.0044814897701,   -0.014917500317,  0.012145539746,
    0.024427289143,   -0.050797060132,  -0.032785870135,   0.1510555595,     0.082495503128};

cv::Mat fromOctant(std::span<const double> octant, int reach) {
    cv::Mat out(2 * reach + 1, 2 * reach + 1, CV_64F);
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            const int far = std::max(std::abs(x), std::abs(y));
            const int near = std::min(std::abs(x), std::abs(y));
            out.at<double>(reach + y, reach + x) =
                octant[static_cast<std::size_t>(far * (far + 1) / 2 + near)];
        }
    return out;
}

cv::Mat verticalEdges() {
    cv::Mat out(9, 9, CV_64F, cv::Scalar(0));
    for (int y = -4; y <= 4; ++y)
        for (int x = 1; x <= 4; ++x) {
            const double tap = kVertical[static_cast<std::size_t>(4 * std::abs(y) + x - 1)];
            out.at<double>(4 + y, 4 + x) = tap;
            out.at<double>(4 + y, 4 - x) = -tap;
        }
    return out;
}

cv::Mat diagonalEdges() {
    cv::Mat out(9, 9, CV_64F, cv::Scalar(0));
    std::size_t i = 0;
    for (int y = 0; y <= 4; ++y)
        for (int x = y + 1; x < 9 - y; ++x) {
            const double tap = kDiagonal[i++];
            out.at<double>(y, x) = out.at<double>(8 - x, 8 - y) = tap;
            out.at<double>(x, y) = out.at<double>(8 - y, 8 - x) = -tap;
        }
    return out;
}

// Number of samples that are computed together, so that their sums stay in registers for all taps.
constexpr int kBlock = 8;
using Samples = Eigen::Array<double, kBlock, 1>;

/// Weighted sums at the columns x, x + 1, ... `row` is the first padded row that the taps cover.
Samples correlatedBlock(const cv::Mat& padded, const cv::Mat& taps, int row, int x) {
    Samples sum = Samples::Zero();
    for (int j = 0; j < taps.rows; ++j) {
        const auto* from = padded.ptr<double>(row + j) + x;
        const auto* tap = taps.ptr<double>(j);
        for (int i = 0; i < taps.cols; ++i)
            sum += tap[i] * Eigen::Map<const Samples>(from + i);
    }
    return sum;
}

}  // namespace

SteerableFilters steerableFilters() {
    SteerableFilters out{fromOctant(kHighPass, 7),
                         fromOctant(kFirstLowPass, 4),
                         fromOctant(kLowPass, 8),
                         {verticalEdges(), diagonalEdges(), {}, {}}};
    out.orientation[2] = -out.orientation[0].t();
    cv::flip(out.orientation[1], out.orientation[3], 1);
    return out;
}

cv::Mat correlate(const cv::Mat& picture, const cv::Mat& taps, int step) {
    CV_Assert(picture.type() == CV_64F && taps.type() == CV_64F && (step == 1 || step == 2));
    cv::Mat padded;
    const int high = taps.rows / 2, wide = taps.cols / 2;
    // The last block of a row reads beyond the requested samples, so the padding is wider there.
    cv::copyMakeBorder(picture, padded, high, high, wide, wide + kBlock, cv::BORDER_REFLECT_101);
    cv::Mat out((picture.rows + step - 1) / step, (picture.cols + step - 1) / step, CV_64F);
    cv::parallel_for_({0, out.rows}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < picture.cols; x += kBlock) {
                const Samples sums = correlatedBlock(padded, taps, y * step, x);
                for (int k = 0; k < std::min(kBlock, picture.cols - x); k += step)
                    out.at<double>(y, (x + k) / step) = sums[k];
            }
    });
    return out;
}

}  // namespace mfar::eval
