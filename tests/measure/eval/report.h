#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mfar::eval {

/// An invalid request or input. The program prints it as one line and exits with status 2.
class EvalError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Throws EvalError if the file cannot be written.
void writeText(const std::filesystem::path& file, const std::string& text);

struct Column {
    std::string name;
    int decimals;
};

/// Returns the field of a CSV file, in quotes if necessary.
[[nodiscard]] std::string csvField(const std::string& field);

/// Results of an evaluation, with one row per recording, frame and method.
class Report {
public:
    explicit Report(std::vector<Column> columns) : columns_(std::move(columns)) {}

    /// `values` has one entry per column. An entry is empty if it was not measured.
    void add(const std::string& recording, const std::string& frame, const std::string& method,
             std::vector<std::optional<double>> values);
    /// Appends the means of each recording and method, with `frame` = "mean". With several
    /// recordings, also appends the means over all frames, with `recording` = "all".
    void addMeans();
    /// Appends medians for the same recordings and methods as addMeans(), with `frame` = "median".
    void addMedians();

    void setHead(std::string head) { head_ = std::move(head); }
    [[nodiscard]] std::string table() const;
    [[nodiscard]] std::string csv() const;
    void writeCsv(const std::filesystem::path& file) const;

    struct Row {
        std::string recording, frame, method;
        std::vector<std::optional<double>> values;
        bool ofFrames = false;  ///< true: means or medians, from addMeans() or addMedians()
    };
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
    [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }

private:
    using Summary = double (*)(std::vector<double>& values);
    void addSummaries(const char* name, Summary summary);
    void addSummary(const char* name, Summary summary, const std::string& label,
                    const std::string& method, const std::vector<const Row*>& of);

    std::vector<Column> columns_;
    std::string head_;
    std::vector<Row> rows_;
};

}  // namespace mfar::eval
