#include "tests/measure/eval/degrade.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mfar::eval {
namespace {

double parseNumber(const std::string& option, const std::string& part, const std::string& text) {
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(text, &used);
    } catch (const std::logic_error&) {
        used = 0;
    }
    if (used == 0 || used != text.size() || !std::isfinite(value))
        throw std::invalid_argument(fmt::format(
            "{}: '{}' has no valid number; expected for example gain=0.7", option, part));
    return value;
}

void assign(Degradation& out, const std::string& option, const std::string& part) {
    const std::size_t equals = part.find('=');
    const std::string key = part.substr(0, equals);
    const double value = parseNumber(
        option, part, equals == std::string::npos ? std::string{} : part.substr(equals + 1));
    const bool factor = key == "gain" || key == "gamma";
    if (key == "gain")
        out.gain = value;
    else if (key == "gamma")
        out.gamma = value;
    else if (key == "blur")
        out.blur = value;
    else if (key == "noise")
        out.noise = value;
    else
        throw std::invalid_argument(
            fmt::format("{}: '{}' is unknown; expected gain, gamma, blur or noise", option, key));
    if (factor ? !(value > 0) : !(value >= 0))
        throw std::invalid_argument(fmt::format(
            "{}: '{}' is out of range; gain and gamma must be above 0, blur and noise at least 0",
            option, part));
}

}  // namespace

Degradation parseDegradation(const std::string& text, const std::string& option) {
    Degradation out;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');)
        assign(out, option, part);
    return out;
}

cv::Mat degrade(const cv::Mat& picture, const Degradation& how, std::uint64_t seed) {
    if (how == Degradation{}) return picture.clone();
    cv::Mat values, out;
    picture.convertTo(values, CV_32F, 1.0 / 255);
    if (how.blur > 0) cv::GaussianBlur(values, values, {}, how.blur);
    values *= how.gain;
    if (how.gamma != 1) cv::pow(cv::max(values, 0), how.gamma, values);
    if (how.noise > 0) {
        cv::Mat noise(values.size(), values.type());
        cv::RNG(seed + 1).fill(noise, cv::RNG::NORMAL, 0, how.noise / 255);
        // In a real sensor, too, values saturate before read-out noise is added.
        values = cv::min(values, 1.0) + noise;
    }
    values.convertTo(out, picture.depth(), 255);
    return out;
}

}  // namespace mfar::eval
