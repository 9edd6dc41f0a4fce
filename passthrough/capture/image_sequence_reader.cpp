#include "passthrough/capture/image_sequence_reader.h"

#include <algorithm>
#include <filesystem>
#include <fnmatch.h>
#include <optional>
#include <regex>
#include <vector>

#include "base/csv.h"
#include "base/error.h"

namespace foveray::passthrough {
namespace {

namespace fs = std::filesystem;

struct Picture {
    Nanoseconds time = 0;
    fs::path file;
};

struct Sequence {
    std::vector<Picture> pictures;
    Nanoseconds end = 0;
};

const std::regex number_pattern("%0?([0-9]*)d");

bool is_picture(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".bmp" ||
           extension == ".tga";
}

/// The number that `name` has in the place of the pattern's %d, if it fits the pattern.
std::optional<std::uint64_t> number_in(const std::string& name, const std::string& before, std::size_t digits,
                                       const std::string& after) {
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after))
        return {};
    const std::string number = name.substr(before.size(), name.size() - before.size() - after.size());
    if (number.size() < digits || number.size() > 18) return {};
    if (!std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c); }))
        return {};
    return std::stoull(number);
}

/// Files of `folder` that fit `pattern` (empty: every picture), in order.
std::vector<fs::path> matching_files(const fs::path& folder, const std::string& pattern) {
    std::smatch match;
    const bool numbered = std::regex_search(pattern, match, number_pattern);
    std::vector<std::pair<std::uint64_t, fs::path>> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_regular_file()) continue;
        if (numbered) {
            const std::size_t digits = match[1].length() > 0 ? std::stoul(match[1]) : 1;
            const auto number = number_in(name, match.prefix(), digits, match.suffix());
            if (number) found.emplace_back(*number, entry.path());
        } else if (pattern.empty() ? is_picture(entry.path())
                                   : fnmatch(pattern.c_str(), name.c_str(), 0) == 0) {
            found.emplace_back(0, entry.path());
        }
    }
    std::sort(found.begin(), found.end());
    std::vector<fs::path> files;
    for (auto& [number, file] : found) files.push_back(std::move(file));
    return files;
}

Sequence read_frames_csv(const fs::path& folder) {
    const CsvTable table = CsvTable::read(folder / "frames.csv");
    const std::size_t time_column = table.column("time_ns"), file_column = table.column("file");
    Sequence sequence;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const Picture picture{table.integer(row, time_column), folder / table.text(row, file_column)};
        if (row > 0 && picture.time <= sequence.pictures.back().time) {
            throw_bad_input(table.where(row), "its time is not after the one before",
                            "sort the rows by time_ns");
        }
        if (!fs::is_regular_file(picture.file)) {
            throw_bad_input(table.where(row), "there is no file '" + table.text(row, file_column) + "'",
                            "add it to the folder or remove the row");
        }
        sequence.pictures.push_back(picture);
    }
    if (sequence.pictures.empty())
        throw_bad_input((folder / "frames.csv").string(), "lists no pictures", "add rows");
    const Nanoseconds first = sequence.pictures.front().time, last = sequence.pictures.back().time;
    const auto intervals = static_cast<Nanoseconds>(sequence.pictures.size() - 1);
    sequence.end =
        last + (intervals > 0 ? (last - first) / intervals : from_seconds(1 / default_sequence_rate_hz));
    return sequence;
}

Sequence find_sequence(const std::string& source) {
    const fs::path path(source);
    const bool whole_folder = fs::is_directory(path);
    const fs::path folder = whole_folder ? path : path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (whole_folder && fs::exists(folder / "frames.csv")) return read_frames_csv(folder);

    if (!fs::is_directory(folder)) throw_bad_input(source, "there is no such folder", "check the path");
    Sequence sequence;
    for (fs::path& file : matching_files(folder, whole_folder ? "" : path.filename().string())) {
        const auto index = static_cast<double>(sequence.pictures.size());
        sequence.pictures.push_back({from_seconds(index / default_sequence_rate_hz), std::move(file)});
    }
    if (sequence.pictures.empty()) {
        throw_bad_input(source, "names no pictures",
                        "use a folder, frame_%04d.png or *.jpg with PNG or JPEG files");
    }
    sequence.end = from_seconds(static_cast<double>(sequence.pictures.size()) / default_sequence_rate_hz);
    return sequence;
}

class ImageSequenceReader : public PictureReader {
  public:
    explicit ImageSequenceReader(const std::string& source)
        : name_(source), sequence_(find_sequence(source)) {
        const Image first = read_image(sequence_.pictures.front().file, 3);
        size_ = {first.width, first.height};
    }

    const std::string& name() const override { return name_; }
    uvec2 picture_size() const override { return size_; }
    Nanoseconds time_of(std::uint64_t index) const override {
        return index < sequence_.pictures.size() ? sequence_.pictures[index].time : sequence_.end;
    }
    bool step() override {
        if (stepped_ == sequence_.pictures.size()) return false;
        ++stepped_;
        return true;
    }
    Image picture() override {
        const fs::path& file = sequence_.pictures[stepped_ - 1].file;
        Image image = read_image(file, 4);
        if (image.width != size_.x || image.height != size_.y) {
            throw_bad_input(file.string(), "its size differs from the sequence's first picture",
                            "scale it to " + std::to_string(size_.x) + "×" + std::to_string(size_.y));
        }
        for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
        return image;
    }
    void rewind() override { stepped_ = 0; }

  private:
    std::string name_;
    Sequence sequence_;
    uvec2 size_{0};
    std::size_t stepped_ = 0;
};

}  // namespace

bool is_image_sequence(const std::string& source) {
    if (fs::is_directory(source)) return true;
    if (fs::exists(source)) return false;
    const std::string name = fs::path(source).filename().string();
    return std::regex_search(name, number_pattern) || name.find_first_of("*?") != std::string::npos;
}

std::unique_ptr<PictureReader> open_image_sequence(const std::string& source) {
    return std::make_unique<ImageSequenceReader>(source);
}

}  // namespace foveray::passthrough
