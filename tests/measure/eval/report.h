#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mfar::eval {

/// A wrong request or unusable input: one line for the user, exit status 2.
class EvalError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Writes a table or a plot. Throws EvalError if the file cannot be written.
void writeText(const std::filesystem::path& file, const std::string& text);

struct Column {
    std::string name;  ///< as in the CSV
    int decimals;      ///< in the table; the CSV has six
};

/// The results of an evaluation: one row per recording, frame and method. Printed as one table and
/// written as one CSV whose columns begin with recording,frame,method.
class Report {
public:
    explicit Report(std::vector<Column> columns) : columns_(std::move(columns)) {}

    /// One value per column; empty if it was not measured.
    void add(const std::string& recording, const std::string& frame, const std::string& method,
             std::vector<std::optional<double>> values);
    /// Appends the means: `frame` = "mean" per recording and method; with several recordings also
    /// recording = "all", over all their frames.
    void addMeans();
    /// The same with the medians of the frames, `frame` = "median".
    void addMedians();

    /// Lines above the table that explain how to read it.
    void setHead(std::string head) { head_ = std::move(head); }
    /// Columns that were never measured are left out.
    [[nodiscard]] std::string table() const;
    [[nodiscard]] std::string csv() const;
    /// Throws EvalError if the file cannot be written.
    void writeCsv(const std::filesystem::path& file) const;

    struct Row {
        std::string recording, frame, method;
        std::vector<std::optional<double>> values;
        bool ofFrames = false;  ///< aggregated over several frames
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
