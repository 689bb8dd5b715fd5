#include "tests/measure/eval/metrics/lpc_si.h"

#include "tests/measure/eval/metrics/complex_fft.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace mfar::eval {
namespace {

constexpr std::size_t kScales = 3;
constexpr int kDirections = 8;
constexpr double kAngleSpread = std::numbers::pi / kDirections / 1.5;
constexpr double kRegularity = 2;    // C of eq. 33
constexpr double kRankDecay = 1e-4;  // beta of eq. 34

using Complex = std::complex<double>;

Complex* complexRow(cv::Mat& values, int y) {
    return reinterpret_cast<Complex*>(values.ptr<cv::Vec2d>(y));
}

/// Frequencies of the bins of one axis [cycles/px]. The divisor is n, or n - 1 if n is odd, as in
/// the authors' release.
std::vector<double> binFrequencies(int n) {
    std::vector<double> out(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k)
        out[static_cast<std::size_t>(k)] =
            static_cast<double>(k <= (n - 1) / 2 ? k : k - n) / (n % 2 == 0 ? n : n - 1);
    return out;
}

struct FilterParts {
    std::array<cv::Mat, kScales> radial;
    cv::Mat angle;
};

FilterParts filterParts(cv::Size size, double sigmaRatio) {
    constexpr std::array<double, kScales> kCentres{1 / 4.0, 1 / 6.0, 1 / 8.0};
    const double spread = 2 * std::log(sigmaRatio) * std::log(sigmaRatio);
    const auto fx = binFrequencies(size.width), fy = binFrequencies(size.height);
    FilterParts out;
    for (cv::Mat& radial : out.radial)
        radial.create(size, CV_64F);
    out.angle.create(size, CV_64F);
    cv::parallel_for_({0, size.height}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < size.width; ++x) {
                const double u = fx[static_cast<std::size_t>(x)];
                const double v = fy[static_cast<std::size_t>(y)];
                const double rho = std::hypot(u, v);
                const double corner = 1 / (1 + std::pow(rho / 0.45, 30));
                out.angle.at<double>(y, x) = std::atan2(-v, u);
                for (std::size_t s = 0; s < kScales; ++s) {
                    const double octaves = std::log(rho / kCentres[s]);
                    out.radial[s].at<double>(y, x) =
                        rho > 0 ? corner * std::exp(-octaves * octaves / spread) : 0;
                }
            }
    });
    return out;
}

/// Adds the sums of the rows in order, so that the result does not depend on the number of threads.
double sumOf(cv::Size size, const std::function<double(int y, int x)>& value) {
    std::vector<double> sums(static_cast<std::size_t>(size.height), 0);
    cv::parallel_for_({0, size.height}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < size.width; ++x)
                sums[static_cast<std::size_t>(y)] += value(y, x);
    });
    double out = 0;
    for (const double sum : sums)
        out += sum;
    return out;
}

class LpcFilterBank {
public:
    LpcFilterBank(const cv::Mat& picture, double sigmaRatio)
        : parts_(filterParts(picture.size(), sigmaRatio)),
          inverse_(picture.size(), ComplexFft::Direction::Inverse),
          coherent_(picture.size(), CV_64F, cv::Scalar(0)), weight_(coherent_.clone()) {
        std::vector<cv::Mat> planes{picture, cv::Mat::zeros(picture.size(), CV_64F)};
        cv::merge(planes, spectrum_);
        ComplexFft(picture.size(), ComplexFft::Direction::Forward).run(spectrum_);
        for (cv::Mat& response : responses_)
            response.create(picture.size(), CV_64FC2);
    }

    LpcOrientation add(int j, const cv::Rect& inside) {
        LpcOrientation out;
        out.filterSum = respond(j * std::numbers::pi / kDirections);
        const cv::Mat amplitude = amplitudeOf(0);
        cv::Scalar mean, deviation;
        cv::meanStdDev(amplitude(inside), mean, deviation);
        const double n = inside.area();
        out.mean = mean[0];
        out.deviation = deviation[0] * std::sqrt(n / (n - 1));
        out.threshold = out.mean + 2 * out.deviation;
        out.coarserMean = {cv::mean(amplitudeOf(1))[0], cv::mean(amplitudeOf(2))[0]};
        out.energy = accumulate(amplitude, out.threshold);
        return out;
    }

    [[nodiscard]] cv::Mat map() const { return coherent_ / (weight_ + kRegularity); }

private:
    /// Filters the picture at every scale. Returns the sum of each filter's gains.
    std::array<double, kScales> respond(double direction) {
        cv::Mat lobe(spectrum_.size(), CV_64F);
        cv::parallel_for_({0, lobe.rows}, [&](const cv::Range& rows) {
            for (int y = rows.start; y < rows.end; ++y)
                for (int x = 0; x < lobe.cols; ++x) {
                    const double off = std::remainder(parts_.angle.at<double>(y, x) - direction,
                                                      2 * std::numbers::pi);
                    lobe.at<double>(y, x) =
                        std::exp(-off * off / (2 * kAngleSpread * kAngleSpread));
                }
        });
        const double scale = 1 / static_cast<double>(spectrum_.total());
        std::array<double, kScales> sums{};
        cv::parallel_for_({0, static_cast<int>(kScales)}, [&](const cv::Range& scales) {
            for (auto s = static_cast<std::size_t>(scales.start);
                 s < static_cast<std::size_t>(scales.end); ++s) {
                const cv::Mat gain = lobe.mul(parts_.radial[s]);
                sums[s] = cv::sum(gain)[0];
                for (int y = 0; y < gain.rows; ++y) {
                    const Complex* from = complexRow(spectrum_, y);
                    Complex* to = complexRow(responses_[s], y);
                    for (int x = 0; x < gain.cols; ++x)
                        to[x] = from[x] * (scale * gain.at<double>(y, x));
                }
                inverse_.run(responses_[s]);
            }
        });
        return sums;
    }

    [[nodiscard]] cv::Mat amplitudeOf(std::size_t scale) {
        cv::Mat out(spectrum_.size(), CV_64F);
        cv::parallel_for_({0, out.rows}, [&](const cv::Range& rows) {
            for (int y = rows.start; y < rows.end; ++y) {
                const Complex* from = complexRow(responses_[scale], y);
                for (int x = 0; x < out.cols; ++x)
                    out.at<double>(y, x) = std::sqrt(std::norm(from[x]));
            }
        });
        return out;
    }

    /// Eq. 32 for one pixel; negative results become 0.
    static double coherence(const Complex& c1, const Complex& c2, const Complex& c3) {
        const auto phase = [](const Complex& c) {
            const double amplitude = std::sqrt(std::norm(c));
            return amplitude > 0 ? c / amplitude : Complex(1, 0);
        };
        const Complex a = phase(c1), b = std::conj(phase(c2)), c = phase(c3);
        return std::max(0.0, (a * b * b * b * c * c).real());
    }

    /// Adds one orientation to the numerator and the denominator of eq. 33 (Hassen, Wang, Salama
    /// 2013) at every pixel. Returns the sum of the orientation's weights over all pixels.
    double accumulate(const cv::Mat& amplitude, double threshold) {
        return sumOf(amplitude.size(), [&](int y, int x) {
            const double energy = amplitude.at<double>(y, x) - threshold;
            if (!(energy > 0)) return 0.0;
            coherent_.at<double>(y, x) +=
                energy * coherence(complexRow(responses_[0], y)[x], complexRow(responses_[1], y)[x],
                                   complexRow(responses_[2], y)[x]);
            weight_.at<double>(y, x) += energy;
            return energy;
        });
    }

    FilterParts parts_;
    ComplexFft inverse_;
    cv::Mat spectrum_, coherent_, weight_;
    std::array<cv::Mat, kScales> responses_;
};

/// Eqs. 34 and 35: mean of the sorted values, with weights that decrease with the rank.
double pooled(const cv::Mat& map) {
    std::vector<double> values;
    for (int y = 0; y < map.rows; ++y)
        values.insert(values.end(), map.ptr<double>(y), map.ptr<double>(y) + map.cols);
    const auto last = static_cast<double>(values.size() - 1);
    // Values with a weight below 1e-17 change nothing and are skipped.
    const auto count =
        std::min(values.size(), static_cast<std::size_t>(40 * kRankDecay * last) + 2);
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(values.begin(), end, values.end(), std::greater<>());
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double weight = std::exp(-static_cast<double>(k) / last / kRankDecay);
        sum += weight * values[k];
        weights += weight;
    }
    return sum / weights;
}

double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto i = static_cast<std::size_t>(at);
    const auto next = std::min(i + 1, sorted.size() - 1);
    return sorted[i] + (at - static_cast<double>(i)) * (sorted[next] - sorted[i]);
}

}  // namespace

LpcSharpness lpcSharpness(const cv::Mat& picture, double sigmaRatio) {
    if (picture.type() != CV_64F || std::min(picture.cols, picture.rows) < kLpcSmallestSide)
        throw std::invalid_argument("LPC-SI: picture must be CV_64F of 32x32 pixels at least");
    if (!cv::checkRange(picture))
        throw std::invalid_argument("LPC-SI: a pixel of the picture is not a finite number");
    if (!(sigmaRatio > 0 && sigmaRatio < 1))
        throw std::invalid_argument("LPC-SI: the ratio of the filters must be in (0, 1)");
    const int border = static_cast<int>(std::lround(std::min(picture.cols, picture.rows) / 16.0));
    const cv::Rect inside(border, border, picture.cols - 2 * border, picture.rows - 2 * border);
    LpcFilterBank bank(picture, sigmaRatio);
    LpcSharpness out;
    for (int j = 0; j < kDirections; ++j)
        out.orientations[static_cast<std::size_t>(j)] = bank.add(j, inside);
    const cv::Mat map = bank.map()(inside);
    cv::minMaxLoc(map, nullptr, &out.mapMax);
    out.mapMean = cv::mean(map)[0];
    out.index = pooled(map);
    return out;
}

double lpcSi(const cv::Mat& picture, double sigmaRatio) {
    return lpcSharpness(picture, sigmaRatio).index;
}

LpcTiles lpcTiles(const cv::Mat& picture, double sigmaRatio) {
    const cv::Size tile(picture.cols / kLpcTiles, picture.rows / kLpcTiles);
    std::vector<double> values;
    for (int y = 0; y < kLpcTiles; ++y)
        for (int x = 0; x < kLpcTiles; ++x)
            values.push_back(lpcSi(
                picture(cv::Rect({x * tile.width, y * tile.height}, tile)).clone(), sigmaRatio));
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.1), quantile(values, 0.5), quantile(values, 0.9)};
}

}  // namespace mfar::eval
