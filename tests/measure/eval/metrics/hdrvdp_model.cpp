#include "tests/measure/eval/metrics/hdrvdp_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace mfar::eval::hdrvdp {
namespace {

constexpr int kLuminances = 2048;
constexpr int kCurveSamples = 256;
constexpr double kLeastLog = -5, kMostLog = 5;
// integrated() multiplies the model's sensitivities by this value / 10^-2.4, so that they equal
// measured ones.
constexpr double kPeakSensitivity = 0.006894596;

template <std::size_t N>
double interpolated(const std::array<double, N>& at, const std::array<double, N>& values,
                    double x) {
    const bool rising = at.front() < at.back();
    x = std::clamp(x, std::min(at.front(), at.back()), std::max(at.front(), at.back()));
    std::size_t i = 1;
    while (i + 1 < N && (rising ? at[i] < x : at[i] > x))
        ++i;
    const double t = (x - at[i - 1]) / (at[i] - at[i - 1]);
    return values[i - 1] + t * (values[i] - values[i - 1]);
}

double fromLogTable(const std::vector<double>& table, double log) {
    const auto last = static_cast<double>(table.size() - 1);
    const double at =
        (std::clamp(log, kLeastLog, kMostLog) - kLeastLog) / (kMostLog - kLeastLog) * last;
    const auto i = static_cast<std::size_t>(std::min(std::floor(at), last - 1));
    return table[i] + (at - static_cast<double>(i)) * (table[i + 1] - table[i]);
}

double luminanceAt(int i) {
    return std::pow(10, kLeastLog + (kMostLog - kLeastLog) * i / (kLuminances - 1));
}

/// Sensitivity of the L cones at every luminance Y of the table; that of the M cones is equal. Both
/// are (jointSensitivity(2 Y) - rodSensitivity(2 Y)) / 2.
std::vector<double> coneSensitivities() {
    std::vector<double> both(kLuminances), out(kLuminances);
    for (int i = 0; i < kLuminances; ++i)
        both[i] = std::max(jointSensitivity(luminanceAt(i)) - rodSensitivity(luminanceAt(i)), 1e-3);
    int k = 0;
    for (int i = 0; i < kLuminances; ++i) {
        const double twice = std::min(2 * luminanceAt(i), luminanceAt(kLuminances - 1));
        while (k < kLuminances - 2 && luminanceAt(k + 1) < twice)
            ++k;
        const double t = (twice - luminanceAt(k)) / (luminanceAt(k + 1) - luminanceAt(k));
        out[i] = 0.5 * (both[k] + t * (both[k + 1] - both[k]));
    }
    return out;
}

/// Number of just noticeable steps from the darkest luminance to each luminance.
std::vector<double> integrated(const std::vector<double>& sensitivity) {
    const double step = (kMostLog - kLeastLog) / (kLuminances - 1) * std::numbers::ln10;
    const double scale = kPeakSensitivity / std::pow(10, -2.4);
    std::vector<double> out(sensitivity.size(), 0);
    for (std::size_t i = 1; i < out.size(); ++i)
        out[i] = out[i - 1] + scale * step * (sensitivity[i - 1] + sensitivity[i]) / 2;
    return out;
}

}  // namespace

double opticsGain(double frequency) {
    constexpr double kQ = 0.99727370023777070, kR = 0.061466549455263;
    return kQ * (0.426 * std::exp(-0.028 * frequency) + 0.574 * std::exp(-0.37 * frequency)) +
           (1 - kQ) * (kR * std::exp(-37 * frequency) + (1 - kR) * std::exp(-360 * frequency));
}

double jointSensitivity(double luminance) {
    return 30.162 * std::pow(std::pow(4.0627 / luminance, 1.6596) + 1, -0.2712);
}

double rodSensitivity(double luminance) {
    const double t = std::log10(luminance / 1.1732);
    const double exponent = luminance > 1.1732 ? std::pow(std::abs(t), 2.9899) / 0.5547
                                               : std::pow(std::abs(t), 1.2167) / 1.1478;
    return std::pow(10, 1.1414) * std::exp(-exponent);
}

double neuralSensitivity(double frequency, double luminance) {
    if (!(frequency > 0)) return 0;
    static const std::array<double, 6> kLogLuminance{std::log10(0.002), std::log10(0.02),
                                                     std::log10(0.2),   std::log10(2.0),
                                                     std::log10(20.0),  std::log10(150.0)};
    constexpr std::array<std::array<double, 6>, 4> kParameters{
        {{0.991265, 0.800889, 0.476505, 0.405782, 0.334278, 0.394533},
         {3.74038, 3.54104, 4.37453, 4.40602, 3.79542, 2.7755},
         {0.50722, 0.682505, 0.750315, 0.935314, 1.07327, 1.16577},
         {4.46044, 4.94958, 5.28678, 5.61425, 6.4635, 7.45665}}};
    std::array<double, 4> p{};
    for (std::size_t k = 0; k < p.size(); ++k)
        p[k] = interpolated(kLogLuminance, kParameters[k], std::log10(luminance));
    const double high = 1 + std::pow(p[0] * frequency, p[1]);
    const double low = 1 - std::exp(-(frequency / 7) * (frequency / 7));
    return p[3] / std::sqrt(high / std::pow(low, p[2]));
}

const std::array<ReceptorWeights, 3>& rgbWeights(Emission emission) {
    static constexpr std::array<std::array<ReceptorWeights, 3>, 3> kWeights{
        {{{{0.198996120337929, 0.0410058604075889, 0.0143773686211192},
           {0.404762607038125, 0.254923306441346, 0.480920841084132},
           {0.0543906192553212, 0.0500122489593007, 0.45427589566936}}},
         {{{0.178717470832544, 0.0472952893423273, 0.0688682732168711},
           {0.441718417647363, 0.264952931503019, 0.584439209301964},
           {0.0372989838133378, 0.0340675162107671, 0.330973586775301}}},
         {{{0.193521438567804, 0.0450532090857062, 0.0470736661755417},
           {0.41422401076384, 0.256275195962185, 0.538454767533398},
           {0.0507166362862674, 0.0452380197199973, 0.400413942316388}}}}};
    return kWeights.at(static_cast<std::size_t>(emission));
}

const Masking& masking() {
    static const Masking kMasking{std::pow(10, 0.544068), std::pow(10, 0.49576),
                                  std::pow(10, 0.189065), std::pow(10, 0.449199),
                                  std::pow(10, 1.52512)};
    return kMasking;
}

ReceptorResponse::ReceptorResponse() : cone_(integrated(coneSensitivities())) {
    std::vector<double> rods(kLuminances);
    for (int i = 0; i < kLuminances; ++i)
        rods[i] = rodSensitivity(luminanceAt(i));
    rod_ = integrated(rods);
}

double ReceptorResponse::at(const std::vector<double>& table, double luminance) {
    return fromLogTable(table, std::log10(luminance));
}

SensitivityCurve::SensitivityCurve(double frequency) : values_(kCurveSamples) {
    for (int i = 0; i < kCurveSamples; ++i)
        values_[i] = neuralSensitivity(
            frequency, std::pow(10, kLeastLog + (kMostLog - kLeastLog) * i / (kCurveSamples - 1)));
}

double SensitivityCurve::at(double log10Luminance) const {
    return fromLogTable(values_, log10Luminance);
}

double qualityWeight(double frequency) {
    constexpr std::array<double, 10> kFrequencies{60,    30,     15,     7.5,    3.75,
                                                  1.875, 0.9375, 0.4688, 0.2344, 0.1172};
    constexpr std::array<double, 10> kWeights{0,      0.2832, 0.2832, 0.2142, 0.2690,
                                              0.0398, 0.0003, 0.0003, 0,      0};
    return interpolated(kFrequencies, kWeights, frequency);
}

double qualityWeight220(double frequency) {
    constexpr std::array<double, 7> kFrequencies{15, 7.5, 3.75, 1.875, 0.9375, 0.4688, 0.2344};
    constexpr std::array<double, 7> kWeights{0.2832, 0.2142, 0.2690, 0.0398,
                                             0.0003, 0.0003, 0.0002};
    return interpolated(kFrequencies, kWeights, frequency);
}

}  // namespace mfar::eval::hdrvdp
