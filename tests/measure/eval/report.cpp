#include "tests/measure/eval/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <fstream>
#include <iterator>
#include <numeric>

namespace mfar::eval {
namespace {

void addUnique(std::vector<std::string>& list, const std::string& value) {
    if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

std::string layOut(const std::vector<std::vector<std::string>>& lines) {
    std::vector<std::size_t> widths(lines.front().size(), 0);
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i)
            widths[i] = std::max(widths[i], line[i].size());
    std::string out;
    for (const auto& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i)
            out += i < 3 ? fmt::format("{:<{}}  ", line[i], widths[i])
                         : fmt::format("{:>{}}  ", line[i], widths[i]);
        out.erase(out.find_last_not_of(' ') + 1);
        out += '\n';
    }
    return out;
}

}  // namespace

std::string csvField(const std::string& field) {
    if (field.find_first_of(",\"\n") == std::string::npos) return field;
    std::string out = "\"";
    for (const char c : field) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + '"';
}

void writeText(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file);
    out << text;
    if (!out.flush()) throw EvalError(fmt::format("{}: cannot be written", file.string()));
}

void Report::add(const std::string& recording, const std::string& frame, const std::string& method,
                 std::vector<std::optional<double>> values) {
    assert(values.size() == columns_.size());
    rows_.push_back({recording, frame, method, std::move(values)});
}

void Report::addSummary(const char* name, Summary summary, const std::string& label,
                        const std::string& method, const std::vector<const Row*>& of) {
    if (of.empty()) return;
    Row out{label, name, method, std::vector<std::optional<double>>(columns_.size()), true};
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        std::vector<double> values;
        for (const Row* row : of)
            if (row->values[c]) values.push_back(*row->values[c]);
        if (!values.empty()) out.values[c] = summary(values);
    }
    rows_.push_back(std::move(out));
}

void Report::addSummaries(const char* name, Summary summary) {
    std::vector<Row> frames;
    std::copy_if(rows_.begin(), rows_.end(), std::back_inserter(frames),
                 [](const Row& row) { return !row.ofFrames; });
    std::vector<std::string> recordings, methods;
    for (const Row& row : frames) {
        addUnique(recordings, row.recording);
        addUnique(methods, row.method);
    }
    const auto matching = [&](const std::string* recording, const std::string& method) {
        std::vector<const Row*> out;
        for (const Row& row : frames)
            if (row.method == method && (!recording || row.recording == *recording))
                out.push_back(&row);
        return out;
    };
    for (const std::string& recording : recordings)
        for (const std::string& method : methods)
            addSummary(name, summary, recording, method, matching(&recording, method));
    if (recordings.size() < 2) return;
    for (const std::string& method : methods)
        addSummary(name, summary, "all", method, matching(nullptr, method));
}

void Report::addMeans() {
    addSummaries("mean", [](std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0) /
               static_cast<double>(values.size());
    });
}

void Report::addMedians() {
    addSummaries("median", [](std::vector<double>& values) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    });
}

std::string Report::table() const {
    std::vector<std::size_t> shown;
    for (std::size_t c = 0; c < columns_.size(); ++c)
        if (std::any_of(rows_.begin(), rows_.end(), [&](const Row& r) { return r.values[c]; }))
            shown.push_back(c);
    std::vector<std::vector<std::string>> lines{{"recording", "frame", "method"}};
    for (const std::size_t c : shown)
        lines.front().push_back(columns_[c].name);
    for (const Row& row : rows_) {
        lines.push_back({row.recording, row.frame, row.method});
        for (const std::size_t c : shown)
            lines.back().push_back(
                row.values[c] ? fmt::format("{:.{}f}", *row.values[c], columns_[c].decimals) : "-");
    }
    return head_ + layOut(lines);
}

std::string Report::csv() const {
    std::string out = "recording,frame,method";
    for (const Column& column : columns_)
        out += ',' + column.name;
    out += '\n';
    for (const Row& row : rows_) {
        out += csvField(row.recording) + ',' + csvField(row.frame) + ',' + csvField(row.method);
        for (const auto& value : row.values)
            out += value ? fmt::format(",{:.6f}", *value) : std::string(",");
        out += '\n';
    }
    return out;
}

void Report::writeCsv(const std::filesystem::path& file) const {
    writeText(file, csv());
}

}  // namespace mfar::eval
