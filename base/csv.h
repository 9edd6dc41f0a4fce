#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace foveray {

/// A comma-separated table with a header row. Fields are not quoted; numbers use a point.
class CsvTable {
  public:
    /// Throws Fault(BadInput) naming file and line when it cannot be opened, has no header, or a row's length
    /// differs from the header's.
    static CsvTable read(const std::filesystem::path& file);

    std::size_t row_count() const { return rows_.size(); }
    /// "file:line", for messages.
    std::string where(std::size_t row) const;
    bool has_column(std::string_view name) const;
    /// Throws Fault(BadInput) when there is no such column.
    std::size_t column(std::string_view name) const;

    const std::string& text(std::size_t row, std::size_t column) const { return rows_[row].fields[column]; }
    /// These throw Fault(BadInput) naming file and line; `number` also for NaN and infinity.
    double number(std::size_t row, std::size_t column) const;
    std::int64_t integer(std::size_t row, std::size_t column) const;
    bool boolean(std::size_t row, std::size_t column) const;  // 0, 1, true, false in any case

  private:
    struct Row {
        std::size_t line;
        std::vector<std::string> fields;
    };
    std::filesystem::path file_;
    std::vector<std::string> header_;
    std::vector<Row> rows_;
};

}  // namespace foveray
