#include "daemon/report.h"

#include "base/svg.h"
#include "daemon/report_charts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <span>
#include <string_view>

namespace mfar {
namespace {

using nlohmann::ordered_json;
using svg::escaped;

/// The time bins of the charts are merged until they have this number of pictures on average. The
/// quantiles of fewer pictures would mean little.
constexpr double kPicturesPerBin = 2;

constexpr std::string_view kStyle = R"(
body { margin: 0; background: #f3f4f6; color: #1f2933; font: 14px/1.45 system-ui, sans-serif; }
header, main { max-width: 1460px; margin: 0 auto; padding: 20px 24px; }
header { padding-bottom: 0; }
h1 { font-size: 22px; margin: 0; }
h2 { font-size: 16px; margin: 28px 0 10px; }
header p { margin: 4px 0; color: #52606d; }
.cards { font-size: 0; margin: 0 -5px; }
.card { display: inline-block; vertical-align: top; box-sizing: border-box; margin: 5px;
  background: #fff; border: 1px solid #dde1e6; border-radius: 6px; padding: 10px 14px; font-size: 14px; }
.card b { display: block; font-size: 22px; font-weight: 600; }
.card span { color: #52606d; }
.bad b { color: #b42318; }
.cards svg { display: inline-block; width: 460px; max-width: 100%; height: auto; margin: 5px;
  background: #fff; border: 1px solid #dde1e6; border-radius: 6px; }
img { display: block; max-width: 100%; border-radius: 3px; margin-bottom: 6px; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding-bottom: 4px; }
th { text-align: left; font-weight: normal; color: #52606d; padding: 1px 16px 1px 0; }
td { text-align: right; padding: 1px 0 1px 12px; }
td.text { text-align: left; max-width: 420px; }
.left td { text-align: left; }
)";

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8U | (i + k < bytes.size() ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63U];
    }
    return out;
}

std::string words(std::string key) {
    for (char& c : key)
        if (c == '_') c = ' ';
    return key;
}

std::string cell(const ordered_json& value) {
    if (value.is_string())
        return fmt::format("<td class=\"text\">{}</td>", escaped(value.get<std::string>()));
    const std::string text =
        value.is_number_float() ? fmt::format("{:.5g}", value.get<double>()) : value.dump();
    return fmt::format("<td>{}</td>", escaped(text));
}

/// Returns a table row for each value of an object. The values of an inner object get rows whose
/// headings begin with the inner object's name.
std::string rows(const ordered_json& object, const std::string& prefix = "") {
    std::string out;
    for (const auto& [key, value] : object.items())
        out += value.is_object() ? rows(value, prefix + words(key) + ": ")
                                 : fmt::format("<tr><th>{}</th>{}</tr>\n",
                                               escaped(prefix + words(key)), cell(value));
    return out;
}

/// Returns true if an object has several values and all are objects, as in {"flow": {"median": 1,
/// "p99": 2}, "detail": {"median": 3, "p99": 4}}.
bool isMatrix(const ordered_json& object) {
    if (object.size() < 2) return false;
    for (const auto& value : object)
        if (!value.is_object()) return false;
    return true;
}

/// Returns a table with a row for each inner object and a column for each key. Cells stay empty
/// where an inner object lacks the key.
std::string columns(const ordered_json& object) {
    ordered_json keys = ordered_json::object();
    for (const auto& inner : object)
        for (const auto& [key, value] : inner.items())
            keys[key] = nullptr;
    std::string out = "<tr><th></th>";
    for (const auto& [key, value] : keys.items())
        out += fmt::format("<td>{}</td>", escaped(words(key)));
    out += "</tr>\n";
    for (const auto& [name, inner] : object.items()) {
        out += fmt::format("<tr><th>{}</th>", escaped(words(name)));
        for (const auto& [key, value] : keys.items())
            out += inner.contains(key) ? cell(inner[key]) : "<td></td>";
        out += "</tr>\n";
    }
    return out;
}

/// Returns the object with its outer and inner keys swapped. If there are few inner objects with
/// many keys, this makes the table narrow.
ordered_json transposed(const ordered_json& object) {
    ordered_json out = ordered_json::object();
    for (const auto& [name, inner] : object.items())
        for (const auto& [key, value] : inner.items())
            out[key][name] = value;
    return out;
}

std::string matrix(const ordered_json& object) {
    const bool isWide = object.front().size() > object.size();
    return columns(isWide ? transposed(object) : object);
}

std::string table(const std::string& title, const std::string& body, std::string_view look = "") {
    if (body.empty()) return "";
    return fmt::format("<div class=\"card {}\"><table><caption>{}</caption>\n{}</table></div>\n",
                       look, escaped(title), body);
}

/// Returns a table row for each step in a text such as "still gles, flow simd". Returns no row for
/// the texts "simd" and "gles": they mean that all steps run on one engine.
std::string engineRows(std::string_view engine) {
    std::string out;
    while (engine.find(' ') != engine.npos) {
        const std::string_view step = engine.substr(0, engine.find(", "));
        const std::size_t space = step.find(' ');
        if (space == step.npos) break;
        out += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", escaped(step.substr(0, space)),
                           escaped(step.substr(space + 1)));
        engine.remove_prefix(std::min(step.size() + 2, engine.size()));
    }
    return out;
}

std::string tables(const ordered_json& summary) {
    ordered_json scalars = ordered_json::object();
    std::string out;
    for (const auto& [key, value] : summary.items()) {
        if (!value.is_object())
            scalars[key] = value;
        else if (!value.empty())
            out += table(words(key), isMatrix(value) ? matrix(value) : rows(value));
    }
    const std::string engines = engineRows(summary.value("engine", ""));
    return table("run", rows(scalars), "left") + table("engine of each step", engines) + out;
}

std::string card(const std::string& value, std::string_view meaning, bool isBad = false) {
    return fmt::format("<div class=\"card{}\"><b>{}</b><span>{}</span></div>\n",
                       isBad ? " bad" : "", escaped(value), meaning);
}

std::string cards(const ordered_json& summary) {
    const auto number = [&](const char* path) {
        return summary.value(ordered_json::json_pointer(path), 0.0);
    };
    const double frames = number("/frames"), late = number("/quality/late");
    double dropped = 0;
    for (const auto& [cause, count] : summary["drops"].items())
        dropped += count.get<double>();
    std::string out = card(fmt::format("{:.1f}", number("/fps")), "frames per second");
    out += card(fmt::format("{:.0f}", frames), "frames");
    out += card(fmt::format("{:.3g} s", number("/seconds")), "from first to last picture");
    out += card(fmt::format("{:.1f} ms", number("/latency_ms/median")), "latency, median");
    out += card(fmt::format("{:.1f} ms", number("/latency_ms/p99")), "latency, 99 % quantile");
    out += card(fmt::format("{:.0f}", dropped), "frames dropped", dropped > 0);
    if (number("/quality/deadline_ms") > 0)
        out += card(fmt::format("{:.1f} %", frames > 0 ? 100 * late / frames : 0), "frames late",
                    late > 0.05 * frames);
    out += card(fmt::format("{:.2f}", number("/mean_confidence")), "mean confidence");
    out += card(fmt::format("{:.0f} %", 100 * number("/pose/tracked_share")), "frames with a pose");
    out += card(fmt::format("{:.0f}", number("/stills/used")), "stills used");
    return out + card(fmt::format("{:.0f}", number("/faults") + number("/gpu_failures")), "faults",
                      number("/faults") + number("/gpu_failures") > 0);
}

std::string picture(std::span<const std::uint8_t> jpeg, std::string_view meaning) {
    if (jpeg.empty()) return "";
    return fmt::format("<div class=\"card\"><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"/>"
                       "<span>{0}</span></div>\n",
                       meaning, base64(jpeg));
}

std::string section(std::string_view title, const std::string& body) {
    if (body.empty()) return "";
    return fmt::format("<h2>{}</h2>\n<div class=\"cards\">\n{}</div>\n", title, body);
}

}  // namespace

std::string reportPage(const ordered_json& summary, RunHistory history, const RunPictures& pictures,
                       const std::string& written) {
    history.fold(kPicturesPerBin);
    const auto text = [&](const char* key) { return escaped(summary.value(key, "")); };
    const double deadline = summary.value(ordered_json::json_pointer("/quality/deadline_ms"), 0.0);
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta "
        "name=\"viewport\" content=\"width=device-width\"/>\n<title>mfard, {0}</title>\n"
        "<style>{1}</style>\n</head>\n<body>\n<header>\n<h1>mfard</h1>\n<p>{0}; {2}, exit code "
        "{3}; "
        "version {4}</p>\n<p>engine {5}; {6}</p>\n<p>{7}; display {8}; mode "
        "{9}</p>\n</header>\n<main>\n",
        escaped(written), kStyle, text("exit_reason"), summary.value("exit_code", 0),
        text("version"), text("engine"), text("renderer"), text("source"), text("display"),
        text("mode"));
    out += section("In short", cards(summary));
    out += section("Pictures", picture(pictures.frame, "last picture shown") +
                                   picture(pictures.still, "last still used"));
    if (!history.bins().empty()) {
        out += section("The run", runCharts(history, deadline));
        out += section("Time of each stage", stageCharts(history));
    }
    out += section("Numbers of the whole run", tables(summary));
    return out + "</main>\n</body>\n</html>\n";
}

}  // namespace mfar
