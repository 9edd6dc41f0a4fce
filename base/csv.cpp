#include "base/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "base/error.h"

namespace foveray {
namespace {

std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> fields;
    while (true) {
        const std::size_t comma = line.find(',');
        std::string_view field = line.substr(0, comma);
        while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
        while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
        fields.emplace_back(field);
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file)) {
        throw_bad_input(file.string(), "cannot be opened", "check the path");
    }
    CsvTable table;
    table.file_ = file;
    std::string line;
    for (std::size_t number = 1; std::getline(in, line); ++number) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty()) continue;
        auto fields = split(line);
        if (table.header_.empty()) {
            table.header_ = std::move(fields);
            continue;
        }
        if (fields.size() != table.header_.size()) {
            throw_bad_input(file.string() + ":" + std::to_string(number),
                            "has " + std::to_string(fields.size()) + " fields where the header has " +
                                std::to_string(table.header_.size()),
                            "complete or remove that row");
        }
        table.rows_.push_back({number, std::move(fields)});
    }
    if (table.header_.empty()) throw_bad_input(file.string(), "is empty", "it needs a header row");
    return table;
}

std::string CsvTable::where(std::size_t row) const {
    return file_.string() + ":" + std::to_string(rows_[row].line);
}

bool CsvTable::has_column(std::string_view name) const {
    return std::find(header_.begin(), header_.end(), name) != header_.end();
}

std::size_t CsvTable::column(std::string_view name) const {
    const auto it = std::find(header_.begin(), header_.end(), name);
    if (it == header_.end()) {
        throw_bad_input(file_.string() + ":1", "has no column '" + std::string(name) + "'",
                        "add it to the header");
    }
    return static_cast<std::size_t>(it - header_.begin());
}

double CsvTable::number(std::size_t row, std::size_t column) const {
    const std::string& s = text(row, column);
    double value = 0;
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (error != std::errc{} || end != s.data() + s.size() || !std::isfinite(value)) {
        throw_bad_input(where(row), "'" + s + "' in column '" + header_[column] + "' is not a finite number",
                        "correct the value");
    }
    return value;
}

std::int64_t CsvTable::integer(std::size_t row, std::size_t column) const {
    const std::string& s = text(row, column);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (error != std::errc{} || end != s.data() + s.size()) {
        throw_bad_input(where(row), "'" + s + "' in column '" + header_[column] + "' is not a whole number",
                        "correct the value");
    }
    return value;
}

bool CsvTable::boolean(std::size_t row, std::size_t column) const {
    std::string s = text(row, column);
    std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return std::tolower(c); });
    if (s == "1" || s == "true") return true;
    if (s == "0" || s == "false") return false;
    throw_bad_input(where(row),
                    "'" + text(row, column) + "' in column '" + header_[column] + "' is not 0 or 1",
                    "correct the value");
}

}  // namespace foveray
